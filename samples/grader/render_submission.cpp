// Inside: the process that a learner's code runs in.
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "grader/picture.h"
#include "grader/submission.h"
#include "live/load.h"
#include "relief/file.h"

namespace relief::samples::grader {

namespace {

// From here on this process starts no other: who tries (fork, exec, a new thread group) is ended. The limit that a
// system has for it (RLIMIT_NPROC) counts a user's processes all together, and does not hold for root. Threads stay:
// glibc takes clone where there is no clone3. Where the processor is another one, the limits on time have to do.
void startNoProcess()
{
#if defined(__x86_64__) || defined(__aarch64__)
    constexpr sock_filter kEnd = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS);
    static constexpr auto kLoad = [](std::size_t offset) {
        return sock_filter BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(offset));
    };
    // Jumps over `skip` instructions where the number is another one.
    static constexpr auto kUnless = [](unsigned number, unsigned char skip) {
        return sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, 0, skip);
    };
    sock_filter program[] = {
        kLoad(offsetof(seccomp_data, nr)),
#if defined(__x86_64__)
        kUnless(SYS_fork, 1),
        kEnd,
        kUnless(SYS_vfork, 1),
        kEnd,
        sock_filter BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000u, 0, 1),  // the x32 calls
        kEnd,
#endif
        kUnless(SYS_execve, 1),
        kEnd,
        kUnless(SYS_execveat, 1),
        kEnd,
        kUnless(SYS_unshare, 1),
        kEnd,
        kUnless(SYS_clone3, 1),
        sock_filter BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS),
        kUnless(SYS_clone, 3),
        kLoad(offsetof(seccomp_data, args)),
        sock_filter BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, 0x00010000u, 1, 0),  // CLONE_THREAD
        kEnd,
        sock_filter BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    const sock_fprog filter = {sizeof program / sizeof program[0], program};
    ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter, 0, 0);
#endif
}

// The object of the file; empty where there are errors, which are told.
std::string compiled(const live::StageSource& source, const std::string& text, const live::PrivateFolder& folder)
{
    const Expected<const live::Toolchain*> toolchain = live::findToolchain();
    if (!toolchain) {
        std::fprintf(stderr, "%s\n", toolchain.error().message.c_str());
        return "";
    }
    live::Compile compile((*toolchain)->path, (*toolchain)->words, {source.path, text}, {.parts = 1, .owners = {}},
                          folder.path, 0);
    live::Compiled result = compile.wait();
    if (result.object.empty()) std::fputs(live::formatted(result.errors).c_str(), stderr);
    return std::move(result.object);
}

int refused(const Error& error)
{
    std::fprintf(stderr, "%s\n", error.message.c_str());
    return 4;
}

bool writeAll(int descriptor, const std::vector<std::uint8_t>& bytes)
{
    for (std::size_t at = 0; at < bytes.size();) {
        const ssize_t written = ::write(descriptor, &bytes[at], bytes.size() - at);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        at += static_cast<std::size_t>(written);
    }
    return true;
}

int render(const std::string& path)
{
    // What the file prints goes where messages go.
    const int output = ::fcntl(1, F_DUPFD_CLOEXEC, 10);
    ::dup2(2, 1);
    const Expected<live::StageSource> source = live::findSource(path);
    if (!source) return refused(source.error());
    const Expected<std::string> text = readText(source->path);
    if (!text) return refused(text.error());
    const Expected<live::PrivateFolder> folder = live::PrivateFolder::create();
    if (!folder) return refused(folder.error());
    const std::string object = compiled(*source, *text, *folder);
    if (object.empty()) return 3;
    startNoProcess();
    const Expected<live::LoadedStage> loaded = live::loadObject(object, *source);
    if (!loaded) return refused(loaded.error());
    const Expected<Framebuffer> picture = draw(loaded->stage, 1);
    if (!picture) return refused(picture.error());
    return writeAll(output, rawBytes(*picture)) ? 0 : 4;
}

}  // namespace

void renderSubmission(const std::string& path)
{
    const int code = render(path);
    std::fflush(stderr);
    ::_exit(code);  // the learner's static destructors are not run
}

}  // namespace relief::samples::grader
