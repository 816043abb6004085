// Outside: starts the process that a learner's code runs in, and takes what it writes.
#include "grader/submission.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/shell.h"
#include "grader/picture.h"
#include "live/toolchain.h"
#include "relief/path.h"

namespace relief::samples::grader {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Words = std::vector<std::string>;

constexpr std::size_t kPictureBytes = std::size_t{kWidth} * kHeight * 5 * sizeof(float);
constexpr std::uint64_t kMostFileBytes = 64 << 20;  // of each file, and of all files in the sandbox

// --- the sandbox ---

void add(Words& words, std::initializer_list<std::string> more)
{
    words.insert(words.end(), more);
}

// A folder to write into, which is thrown away afterwards.
void addMemory(Words& words, const fs::path& folder)
{
    add(words, {"--size", std::to_string(kMostFileBytes), "--tmpfs", folder.string()});
}

// The system's programs and libraries, and nothing of /etc but what leads to them.
void addSystem(Words& words)
{
    add(words, {"--ro-bind", "/usr", "/usr"});
    std::error_code error;
    for (const std::string folder : {"/bin", "/sbin", "/lib", "/lib32", "/lib64"}) {
        if (fs::is_symlink(folder, error)) {
            add(words, {"--symlink", fs::read_symlink(folder, error).string(), folder});
        } else {
            add(words, {"--ro-bind-try", folder, folder});
        }
    }
    add(words, {"--ro-bind-try", "/etc/alternatives", "/etc/alternatives"});
    add(words, {"--ro-bind-try", "/etc/ld.so.cache", "/etc/ld.so.cache"});
    add(words, {"--proc", "/proc", "--dev", "/dev"});
    addMemory(words, "/tmp");  // before what may lie in it: Relief itself
}

// What compiling and drawing a stage needs of Relief. No stage, no exercise, no answer.
void addRelief(Words& words)
{
    const fs::path samples = live::sampleFolder();
    for (const fs::path& path : {samples.parent_path() / "engine", samples.parent_path() / "assets", samples / "common",
                                 samples / "live", fs::path(live::programPath())}) {
        add(words, {"--ro-bind", path.string(), path.string()});
    }
    for (const live::Toolchain& toolchain : live::toolchains()) {
        const std::string folder = fs::path(toolchain.precompiled).parent_path().string();
        add(words, {"--ro-bind-try", folder, folder});
        if (!toolchain.path.starts_with("/usr/")) add(words, {"--ro-bind-try", toolchain.path, toolchain.path});
    }
    addMemory(words, live::liveFolder() + "/objects");
    // Where Relief lies below /usr, that has brought the answers along.
    if (samples.string().starts_with("/usr/")) addMemory(words, samples / "exercises");
}

// Namespaces of its own for processes, network and all the rest: what is started in it ends with it.
Words sandbox()
{
    Words words = {"bwrap",    "--unshare-all", "--die-with-parent", "--new-session", "--cap-drop", "ALL", "--clearenv",
                   "--setenv", "PATH",          "/usr/bin:/bin",     "--setenv",      "HOME",       "/tmp"};
    addSystem(words);
    return words;
}

Words wordsFor(const std::string& path, const Limits& limits)
{
    if (!limits.isSandboxed) return {live::programPath(), "render-submission", path};
    Words words = sandbox();
    addRelief(words);
    const std::string inside = "/submission/" + fs::path(path).filename().string();
    add(words, {"--ro-bind", path, inside, "--chdir", "/submission", live::programPath(), "render-submission", inside});
    return words;
}

// --- the process ---

struct Process
{
    pid_t id = -1;
    int output = -1, messages = -1;
};

void limit(int resource, std::uint64_t number)
{
    const rlimit both = {static_cast<rlim_t>(number), static_cast<rlim_t>(number)};
    ::setrlimit(static_cast<decltype(RLIMIT_AS)>(resource), &both);
}

// After a fork, in a program with threads: calls to the system and nothing else.
[[noreturn]] void become(char* const* words, int output, int messages, const Limits& limits)
{
    ::setpgid(0, 0);
    ::dup2(output, 1);
    ::dup2(messages, 2);
    const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    ::dup2(nothing, 0);
    limit(RLIMIT_CPU, static_cast<std::uint64_t>(limits.seconds + 0.999));
    limit(RLIMIT_AS, static_cast<std::uint64_t>(limits.megabytes) << 20);
    limit(RLIMIT_FSIZE, kMostFileBytes);
    limit(RLIMIT_CORE, 0);
    ::execvp(words[0], words);
    ::_exit(127);
}

Process start(const Words& words, const Limits& limits)
{
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    int output[2], messages[2];
    Process process;
    if (::pipe2(output, O_CLOEXEC) != 0) return process;
    if (::pipe2(messages, O_CLOEXEC) != 0) {
        ::close(output[0]);
        ::close(output[1]);
        return process;
    }
    process.id = ::fork();
    if (process.id == 0) become(arguments.data(), output[1], messages[1], limits);
    ::close(output[1]);
    ::close(messages[1]);
    process.output = output[0];
    process.messages = messages[0];
    return process;
}

// Takes what is there, up to `most` bytes; false at the end. What is beyond is thrown away.
bool take(int& descriptor, std::string& text, std::size_t most)
{
    char buffer[65536];
    const ssize_t size = ::read(descriptor, buffer, sizeof buffer);
    if (size < 0 && errno == EINTR) return true;
    if (size <= 0) {
        ::close(descriptor);
        descriptor = -1;
        return false;
    }
    text.append(buffer, std::min(static_cast<std::size_t>(size), most - std::min(most, text.size())));
    return true;
}

struct Taken
{
    std::string output, messages;
    bool isLate = false;
};

Taken takeAll(Process& process, Clock::time_point until)
{
    Taken taken;
    while (process.output >= 0 || process.messages >= 0) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
        if (left <= 0) {
            taken.isLate = true;
            break;
        }
        pollfd waits[] = {{process.output, POLLIN, 0}, {process.messages, POLLIN, 0}};
        ::poll(waits, 2, static_cast<int>(std::min<long>(left, 60'000)));
        if (waits[0].revents != 0) take(process.output, taken.output, kPictureBytes + 1);
        if (waits[1].revents != 0) take(process.messages, taken.messages, kMostSaid);
        if (taken.output.size() > kPictureBytes) break;
    }
    for (const int descriptor : {process.output, process.messages}) {
        if (descriptor >= 0) ::close(descriptor);
    }
    return taken;
}

// Its status. It may have closed its output and gone on: then it is waited for, and killed when the time is over.
// Whatever it started in its group ends too; in a sandbox all of it, with its first process.
int end(const Process& process, Clock::time_point until, Taken& taken)
{
    int status = 0;
    pid_t ended = 0;
    while (!taken.isLate && taken.output.size() <= kPictureBytes) {
        ended = ::waitpid(process.id, &status, WNOHANG);
        if (ended != 0) break;
        taken.isLate = Clock::now() >= until;
        ::poll(nullptr, 0, 2);
    }
    ::kill(-process.id, SIGKILL);
    if (ended == 0) ::waitpid(process.id, &status, 0);
    return status;
}

std::string oneLine(const std::string& what, const std::string& more)
{
    return what + (more.empty() ? "" : ": " + more.substr(0, more.find('\n')));
}

// What became of it: by how it ended and what it wrote, never by what it says of itself.
void judge(Submission& submission, const Taken& taken, int status, const Limits& limits)
{
    using Outcome = Submission::Outcome;
    submission.said = taken.messages;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : code > 128 ? code - 128 : 0;  // bubblewrap's exit code
    if (taken.output.size() > kPictureBytes) {
        submission.outcome = Outcome::tooMuch;
    } else if (taken.isLate || signal == SIGXCPU || (signal == SIGKILL && submission.seconds >= limits.seconds)) {
        submission.outcome = Outcome::tooLong;
    } else if (code == 0) {
        const auto* const bytes = reinterpret_cast<const std::uint8_t*>(taken.output.data());
        Expected<Framebuffer> picture = pictureOf({bytes, taken.output.size()});
        submission.outcome = picture ? Outcome::drawn : Outcome::crashed;
        if (picture) submission.picture = std::move(*picture);
        if (!picture) submission.said = oneLine("it ended early, without a picture", "");
    } else if (code == 3 || code == 4) {
        submission.outcome = code == 3 ? Outcome::notCompiled : Outcome::refused;
    } else {
        submission.outcome = Outcome::crashed;
        const char* const name = signal == SIGSYS ? "it tried to start another process"
                                 : signal != 0    ? ::strsignal(signal)
                                                  : "it ended without a picture";
        submission.said = oneLine(name, taken.messages);
    }
}

}  // namespace

const char* wordOf(Submission::Outcome outcome)
{
    static constexpr const char* kWords[] = {"drawn",   "not compiled", "cannot be drawn",
                                             "crashed", "too long",     "wrote too much"};
    return kWords[static_cast<std::size_t>(outcome)];
}

Expected<void> checkSandbox()
{
    std::string command;
    for (const std::string& word : sandbox()) command += quoted(word) + " ";
    if (!outputOf("bwrap --version")) {
        return fail(
            "there is no sandbox: install bubblewrap (Debian: apt-get install bubblewrap), or say "
            "--without-sandbox if you trust every file");
    }
    if (outputOf(command + "true")) return {};
    return fail(
        "bubblewrap cannot make a sandbox here: the kernel has to allow user namespaces; try `bwrap --unshare-all "
        "--ro-bind / / true`, or say --without-sandbox if you trust every file");
}

Submission run(const std::string& path, const Limits& limits)
{
    Submission submission;
    std::error_code error;
    const std::string absolute = utf8Of(fs::absolute(pathOf(path), error));
    const Clock::time_point begin = Clock::now();
    Process process = start(wordsFor(absolute, limits), limits);
    if (process.id < 0) {
        submission.said = std::string("no process can be started (") + std::strerror(errno) + "); close other programs";
        return submission;
    }
    const auto wait = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(3.0 * limits.seconds));
    Taken taken = takeAll(process, begin + wait);
    const int status = end(process, begin + wait, taken);
    submission.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    judge(submission, taken, status, limits);
    return submission;
}

}  // namespace relief::samples::grader
