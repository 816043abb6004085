#include "live/renderer.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <sstream>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/shell.h"
#include "live/process.h"

namespace relief::samples::live {

namespace {

using namespace std::chrono_literals;

const char* inWords(int signal)
{
    switch (signal) {
        case SIGSEGV:
        case SIGBUS:
            return "reads or writes memory that is not there, or calls itself without end";
        case SIGFPE:
            return "divides an integer by zero";
        case SIGABRT:
            return "gives up (abort, an exception that nobody catches, or a failed check)";
        case SIGILL:
        case SIGTRAP:
            return "reaches code that must not be reached, such as the end of a function without return";
        default:
            return "ends";
    }
}

// The first line of `source` among those that the addresses of an object stand for, callers after those they called.
int lineOf(const std::string& object, const std::string& source, const std::vector<std::uintptr_t>& addresses)
{
    if (addresses.empty()) return 0;
    std::string arguments = " -i -e " + quoted(object);
    for (const std::uintptr_t address : addresses) {
        char buffer[32];
        std::snprintf(buffer, sizeof buffer, " 0x%llx", static_cast<unsigned long long>(address));
        arguments += buffer;
    }
    std::optional<std::string> output;
    for (const char* const tool : {"addr2line", "llvm-addr2line", "llvm-addr2line-14"}) {
        if (!output) output = outputOf(tool + arguments);
    }
    std::istringstream rows(output.value_or(""));
    for (std::string row; std::getline(rows, row);) {
        const int line = row.starts_with(source + ":") ? std::atoi(row.c_str() + source.size() + 1) : 0;
        if (line > 0) return line;
    }
    return 0;
}

}  // namespace

// --- the maker ---

Expected<std::unique_ptr<Maker>> Maker::start()
{
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
        return fail(std::string("live: no sockets for processes (") + std::strerror(errno) + "); close other programs");
    }
    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        ::close(ends[0]);
        runMaker(ends[1]);
    }
    ::close(ends[1]);
    if (child < 0) {
        ::close(ends[0]);
        return fail(std::string("live: no process for stages (") + std::strerror(errno) + "); close other programs");
    }
    std::unique_ptr<Maker> maker(new Maker);
    maker->socket = ends[0];
    maker->process = child;
    return maker;
}

Maker::~Maker()
{
    ::close(socket);
    ::waitpid(process, nullptr, 0);
}

void Maker::preload(const Inputs& inputs, const InputFiles& files, bool bakes)
{
    Message message(Message::Kind::preload);
    put(message, inputs);
    put(message, files);
    message.put(bakes);
    if (message.bytes == preloaded) return;
    preloaded = message.bytes;
    send(socket, message);
}

Expected<std::unique_ptr<Renderer>> Maker::make(const std::string& object, const StageSource& source)
{
    int ends[2];
    const int memory = ::memfd_create("relief picture", MFD_CLOEXEC);
    if (memory < 0 || ::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
        if (memory >= 0) ::close(memory);
        return fail(std::string("live: no memory or sockets for a picture (") + std::strerror(errno) +
                    "); close other programs");
    }
    Message request(Message::Kind::make);
    request.put(object).put(source.id).put(source.stem).put(source.folder).put(source.tutorial).put(source.path);
    const int given[2] = {ends[1], memory};
    std::string answer;
    const bool made = send(socket, request, given) && receive(socket, answer, true) == Received::message;
    ::close(ends[1]);
    std::unique_ptr<Renderer> renderer(new Renderer);
    renderer->socket = ends[0];
    renderer->memory = memory;
    renderer->file = object;
    renderer->source = source.path;
    renderer->since = Renderer::Clock::now();
    if (made) Message(std::move(answer)).get(renderer->process);
    if (renderer->process <= 0) return fail("live: the process that draws stages cannot be made; start again");
    return renderer;
}

// --- a renderer ---

Renderer::~Renderer()
{
    if (process > 0) ::kill(process, SIGKILL);
    if (picture != nullptr) ::munmap(picture, size);
    ::close(socket);
    ::close(memory);
}

void Renderer::draw(const Look& look)
{
    last = look;
    const std::size_t bytes =
        static_cast<std::size_t>(look.width) * static_cast<std::size_t>(look.height) * sizeof(std::uint32_t);
    if (bytes > size) {
        if (picture != nullptr) ::munmap(picture, size);
        picture = nullptr;
        size = 0;
        if (::ftruncate(memory, static_cast<off_t>(bytes)) == 0) {
            void* const mapped = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, memory, 0);
            if (mapped != MAP_FAILED) picture = static_cast<std::uint32_t*>(mapped);
            if (picture != nullptr) size = bytes;
        }
    }
    Message request(Message::Kind::draw);
    put(request, look);
    send(socket, request);
    asked = true;
    begun = false;
    since = Clock::now();
    processorSince = processorSeconds();
}

std::span<const std::uint32_t> Renderer::pixels() const
{
    const std::size_t count = static_cast<std::size_t>(last.width) * static_cast<std::size_t>(last.height);
    return {picture, count * sizeof(std::uint32_t) <= size ? count : 0};
}

// Of all its threads.
double Renderer::processorSeconds() const
{
    clockid_t clock;
    timespec time = {};
    if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0.0;
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

// Nothing heard for a second, most of which it has worked: on a busy machine it may only have waited for its turn. A
// frame that is known to take longer has more time, and so have those who load files.
bool Renderer::isStuck() const
{
    const double pixels = static_cast<double>(last.width) * last.height;
    const double expected = std::max(millisecondsPerPixel, 1e-4) * pixels * 1e-3;
    const double limit = !begun && base != 0 ? 20.0 : std::max(1.0, 5.0 * expected);
    const std::chrono::duration<double> silent = Clock::now() - since;
    if (silent.count() < limit) return false;
    return processorSeconds() - processorSince >= 0.7 * limit || silent.count() >= 8.0 * limit;
}

std::chrono::milliseconds Renderer::patience() const
{
    return asked || base == 0 ? 100ms : 1h;
}

Failure Renderer::failure(const std::string& what, std::span<const std::uintptr_t> counters) const
{
    // The address of a call is the one before where it returns to; but for the first, at which it stands.
    std::vector<std::uintptr_t> inside;
    std::error_code ignored;
    const std::uintptr_t length = std::filesystem::file_size(file, ignored);
    for (std::size_t i = 0; i < counters.size(); ++i) {
        const std::uintptr_t offset = counters[i] - base - (i == 0 ? 0 : 1);
        if (base != 0 && counters[i] > base && offset < length) inside.push_back(offset);
    }
    return {what, lineOf(file, source, inside)};
}

// Asks every thread where it is. The first that is in the learner's code says the line.
Failure Renderer::stuck()
{
    Failure found{"does not come to an end", 0};
    std::error_code error;
    const std::filesystem::path tasks = "/proc/" + std::to_string(process) + "/task";
    for (const auto& task : std::filesystem::directory_iterator(tasks, error)) {
        const int thread = std::atoi(task.path().filename().c_str());
        ::syscall(SYS_tgkill, process, thread, SIGUSR1);
    }
    const auto until = Clock::now() + 100ms;
    std::string bytes;
    while (Clock::now() < until && found.line == 0) {
        const Received received = receive(socket, bytes, false);
        if (received == Received::end) break;
        if (received == Received::nothing) {
            ::usleep(2000);
            continue;
        }
        Crash crash;
        if (bytes.size() != sizeof crash) continue;
        std::memcpy(&crash, bytes.data(), sizeof crash);
        const auto count = static_cast<std::size_t>(crash.count);
        found = failure(found.what, {crash.counters, std::min(count, std::size(crash.counters))});
    }
    return found;
}

Renderer::News Renderer::poll()
{
    News news;
    std::string bytes;
    const auto gone = [&](const Failure& failure) {
        news.failure = failure;
        asked = false;
        if (process > 0) ::kill(process, SIGKILL);
        process = -1;
    };
    while (process > 0) {
        const Received received = receive(socket, bytes, false);
        if (received == Received::nothing) break;
        since = Clock::now();
        processorSince = processorSeconds();
        if (received == Received::end) {
            gone({"ends by itself, or runs out of stack or memory", 0});
            break;
        }
        Crash crash;
        if (bytes.size() == sizeof crash && bytes[0] == static_cast<char>(Message::Kind::crashed)) {
            std::memcpy(&crash, bytes.data(), sizeof crash);
            const auto count = static_cast<std::size_t>(crash.count);
            gone(failure(inWords(crash.signal), {crash.counters, std::min(count, std::size(crash.counters))}));
            break;
        }
        Message message(bytes);
        switch (message.kind()) {
            case Message::Kind::loaded:
                get(message, news.loaded.emplace());
                message.get(base);
                if (!asked) since = Clock::now();
                break;
            case Message::Kind::begins:
                begun = true;
                break;
            case Message::Kind::drawn:
                message.get(news.drawn.emplace());
                get(message, news.views);
                millisecondsPerPixel = news.drawn->milliseconds / (static_cast<double>(last.width) * last.height);
                asked = false;
                break;
            case Message::Kind::refused:
                message.get(news.refused.emplace());
                asked = false;
                if (base == 0) gone({*news.refused, 0});
                break;
            default:
                break;
        }
    }
    if (process > 0 && !news.drawn && (asked || base == 0) && isStuck()) gone(stuck());
    return news;
}

}  // namespace relief::samples::live
