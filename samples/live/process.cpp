#include "live/process.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>

#include <execinfo.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <ucontext.h>
#include <unistd.h>

#include "common/baked_sphere.h"
#include "common/inside.h"
#include "common/render.h"
#include "live/load.h"
#include "relief/check/hash.h"

namespace relief::samples::live {

// --- messages ---

void put(Message& m, const InputFiles& f)
{
    m.put(f.mesh);
    for (const std::string& file : f.textures) m.put(file);
    m.put(f.import);
}
void get(Message& m, InputFiles& f)
{
    m.get(f.mesh);
    for (std::string& file : f.textures) m.get(file);
    m.get(f.import);
}

void put(Message& m, const Inputs& i)
{
    m.put(i.mesh).put(i.cubesTurnedBy);
    for (const auto& [file, settings] : i.textures) m.put(file).put(settings);
}
void get(Message& m, Inputs& i)
{
    m.get(i.mesh).get(i.cubesTurnedBy);
    for (auto& [file, settings] : i.textures) m.get(file).get(settings);
}

void put(Message& m, const Look& l)
{
    m.put(l.width).put(l.height).put(l.camera.has_value()).put(l.camera.value_or(Camera{})).put(l.settings);
    put(m, l.files);
    m.put(l.threads)
        .put(l.tileSize)
        .put(l.samples)
        .put(l.showTangents)
        .put(l.tangentScale)
        .put(l.tangentOffset)
        .put(l.hash);
    m.put(l.strict).put(l.show);
}
void get(Message& m, Look& l)
{
    bool hasCamera = false;
    Camera camera;
    m.get(l.width).get(l.height).get(hasCamera).get(camera).get(l.settings);
    if (hasCamera) l.camera = camera;
    get(m, l.files);
    m.get(l.threads)
        .get(l.tileSize)
        .get(l.samples)
        .get(l.showTangents)
        .get(l.tangentScale)
        .get(l.tangentOffset)
        .get(l.hash);
    m.get(l.strict).get(l.show);
}

void put(Message& m, const std::vector<ViewName>& views)
{
    m.put(views.size());
    for (const ViewName& view : views) m.put(view.name).put(view.meaning);
}
void get(Message& m, std::vector<ViewName>& views)
{
    std::size_t count = 0;
    m.get(count);
    views.resize(count <= m.bytes.size() ? count : 0);
    for (ViewName& view : views) m.get(view.name).get(view.meaning);
}

void put(Message& m, const Description& d)
{
    m.put(d.title).put(d.news).put(d.properties.size());
    for (const Property& p : d.properties) {
        m.put(p.name).put(p.kind).put(p.components).put(p.value).put(p.minimum).put(p.maximum);
        m.put(p.meaning).put(p.choices);
    }
    put(m, d.inputs);
    m.put(d.camera).put(d.programs);
}
void get(Message& m, Description& d)
{
    std::size_t properties = 0;
    m.get(d.title).get(d.news).get(properties);
    for (std::size_t i = 0; i < properties && i < m.bytes.size(); ++i) {
        Property& p = d.properties.emplace_back();
        m.get(p.name).get(p.kind).get(p.components).get(p.value).get(p.minimum).get(p.maximum);
        m.get(p.meaning).get(p.choices);
    }
    get(m, d.inputs);
    m.get(d.camera).get(d.programs);
}

bool send(int socket, const Message& message, std::span<const int> descriptors)
{
    iovec bytes{const_cast<char*>(message.bytes.data()), message.bytes.size()};
    msghdr header = {};
    header.msg_iov = &bytes;
    header.msg_iovlen = 1;
    alignas(cmsghdr) char control[CMSG_SPACE(2 * sizeof(int))] = {};
    if (!descriptors.empty()) {
        header.msg_control = control;
        header.msg_controllen = CMSG_SPACE(descriptors.size_bytes());
        cmsghdr* const part = CMSG_FIRSTHDR(&header);
        part->cmsg_level = SOL_SOCKET;
        part->cmsg_type = SCM_RIGHTS;
        part->cmsg_len = CMSG_LEN(descriptors.size_bytes());
        std::memcpy(CMSG_DATA(part), descriptors.data(), descriptors.size_bytes());
    }
    ssize_t sent = -1;
    do {
        sent = ::sendmsg(socket, &header, MSG_NOSIGNAL);
    } while (sent < 0 && errno == EINTR);
    return sent >= 0;
}

Received receive(int socket, std::string& received, bool wait, int* descriptors)
{
    static constexpr std::size_t kLargest = 1 << 18;
    received.resize(kLargest);
    iovec bytes{received.data(), received.size()};
    msghdr header = {};
    header.msg_iov = &bytes;
    header.msg_iovlen = 1;
    alignas(cmsghdr) char control[CMSG_SPACE(2 * sizeof(int))] = {};
    header.msg_control = control;
    header.msg_controllen = sizeof control;
    ssize_t size = -1;
    do {
        size = ::recvmsg(socket, &header, MSG_CMSG_CLOEXEC | (wait ? 0 : MSG_DONTWAIT));
    } while (size < 0 && errno == EINTR);
    if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return Received::nothing;
    if (size <= 0) return Received::end;
    received.resize(static_cast<std::size_t>(size));
    const cmsghdr* const part = CMSG_FIRSTHDR(&header);
    if (descriptors != nullptr && part != nullptr) std::memcpy(descriptors, CMSG_DATA(part), 2 * sizeof(int));
    return Received::message;
}

namespace {

// --- a crash ---

int crashSocket = -1;
std::atomic<bool> crashTold{false};

// Tells where this thread is. Also asked for, by the signal of a watchdog, of each thread.
void tellWhere(int signal, siginfo_t*, void* context)
{
    Crash crash;
    crash.signal = signal;
    void* counters[47] = {};
    const int count = ::backtrace(counters, 47);
#if defined(__x86_64__)
    const auto* const state = static_cast<const ucontext_t*>(context);
    crash.counters[crash.count++] = static_cast<std::uintptr_t>(state->uc_mcontext.gregs[REG_RIP]);
#elif defined(__aarch64__)
    const auto* const state = static_cast<const ucontext_t*>(context);
    crash.counters[crash.count++] = static_cast<std::uintptr_t>(state->uc_mcontext.pc);
#else
    (void)context;
#endif
    for (int i = 0; i < count; ++i) crash.counters[crash.count++] = reinterpret_cast<std::uintptr_t>(counters[i]);
    const bool asked = signal == SIGUSR1;
    if (asked || !crashTold.exchange(true)) ::send(crashSocket, &crash, sizeof crash, MSG_NOSIGNAL);
    if (!asked) ::_exit(1);
}

void listenToCrashes(int socket)
{
    crashSocket = socket;
    // A stack that is full has no room for a handler.
    static std::vector<char> otherStack(64 * 1024);
    const stack_t stack = {otherStack.data(), 0, otherStack.size()};
    ::sigaltstack(&stack, nullptr);
    void* first[1];
    ::backtrace(first, 1);  // loads what it needs, outside of a handler
    struct sigaction action = {};
    action.sa_sigaction = tellWhere;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_RESTART;
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGUSR1}) {
        ::sigaction(signal, &action, nullptr);
    }
}

// Where the object of that name begins.
std::uintptr_t baseOf(const std::string& object)
{
    struct Search
    {
        const std::string& name;
        std::uintptr_t base = 0;
    } search{object};
    ::dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* data) {
            auto& s = *static_cast<Search*>(data);
            if (info->dlpi_name != nullptr && s.name == info->dlpi_name) s.base = info->dlpi_addr;
            return 0;
        },
        &search);
    return search.base;
}

// --- a renderer ---

// The stage's properties with these settings. Those that it does not know, or whose values it does not take, are left
// out unless the Look is strict.
Expected<std::vector<Property>> propertiesFor(const Stage& stage, const Look& look)
{
    std::vector<Property> properties = stage.properties();
    for (const std::string& setting : look.settings) {
        const Expected<void> applied = applySetting(setting, stage.id, properties);
        if (!applied && look.strict) return tl::unexpected(applied.error());
    }
    return properties;
}

// One version of a stage, drawn again and again.
struct Drawing
{
    int socket, memory;
    const Stage& stage;
    std::optional<PreparedStage> prepared;
    InputFiles files;
    std::uint32_t* picture = nullptr;
    std::size_t size = 0;  // mapped, in bytes
    std::optional<Framebuffer> target;
    std::unique_ptr<Frame> frame;
    int threads = 0, tileSize = 0;  // the frame's

    Expected<Drawn> draw(const Look& look);
    std::vector<ViewName> views() const;  // of the last frame
    Expected<void> prepare(const Look& look);
    bool map(std::size_t bytes);
};

Expected<void> Drawing::prepare(const Look& look)
{
    Expected<std::vector<Property>> properties = propertiesFor(stage, look);
    if (!properties) return tl::unexpected(properties.error());
    // What is loaded stays: settings change more often than files.
    if (!prepared || files != look.files) {
        Expected<PreparedStage> made = PreparedStage::prepare(stage, {}, look.files);
        if (!made) return tl::unexpected(made.error());
        prepared = std::move(*made);
        files = look.files;
    }
    prepared->properties = std::move(*properties);
    prepared->usersCamera = look.camera;
    prepared->tangentLines.reset();
    if (look.showTangents) prepared->tangentLines = {look.tangentOffset, look.tangentScale};
    return {};
}

bool Drawing::map(std::size_t bytes)
{
    if (bytes <= size) return true;
    if (picture != nullptr) ::munmap(picture, size);
    void* const mapped = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, memory, 0);
    picture = mapped == MAP_FAILED ? nullptr : static_cast<std::uint32_t*>(mapped);
    size = picture != nullptr ? bytes : 0;
    return picture != nullptr;
}

Expected<Drawn> Drawing::draw(const Look& look)
{
    if (const Expected<void> ready = prepare(look); !ready) return tl::unexpected(ready.error());
    const std::size_t pixels = static_cast<std::size_t>(look.width) * static_cast<std::size_t>(look.height);
    if (!frame || target->width() != look.width || target->height() != look.height ||
        target->samples().count != look.samples || threads != look.threads || tileSize != look.tileSize) {
        frame.reset();
        Expected<Framebuffer> made =
            Framebuffer::create(look.width, look.height, Format::rgba8Srgb, Store::discard, look.samples);
        if (!made) return tl::unexpected(made.error());
        target = std::move(*made);
        threads = look.threads;
        tileSize = look.tileSize;
        frame = std::make_unique<Frame>(*target, FrameOptions{.threads = threads, .tileSize = tileSize});
    }
    if (!map(pixels * sizeof(std::uint32_t))) return fail("no memory for a picture of this size; make it smaller");
    send(socket, Message(Message::Kind::begins));

    Drawn drawn{.width = look.width, .height = look.height, .camera = prepared->camera()};
    const auto begin = std::chrono::steady_clock::now();
    prepared->record(*frame, look.width, look.height);
    if (const std::string problem = prepared->problem(*frame); !problem.empty()) return fail(problem);
    const bool isThere = look.strict || look.show.empty() || findView(*frame, look.show);
    const Expected<Statistics> statistics = runInside(*frame, *target, isThere ? look.show : "", prepared->log->labels);
    if (!statistics) return tl::unexpected(statistics.error());
    drawn.statistics = *statistics;
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
    drawn.milliseconds = time.count();
    std::memcpy(picture, target->color8().data(), pixels * sizeof(std::uint32_t));
    if (look.hash) {
        Expected<Framebuffer> exact =
            Framebuffer::create(look.width, look.height, Format::rgba32f, Store::keep, look.samples);
        if (!exact) return tl::unexpected(exact.error());
        Frame again(*exact, {.threads = look.threads, .tileSize = look.tileSize});
        prepared->record(again, look.width, look.height);
        again.run();
        drawn.hash = hashOf(*exact);
    }
    return drawn;
}

std::vector<ViewName> Drawing::views() const
{
    std::vector<ViewName> names;
    for (const View& view : viewsOf(*frame)) names.push_back({view.name, view.meaning});
    return names;
}

[[noreturn]] void runRenderer(int socket, int memory, const std::string& object, const StageSource& source)
{
    listenToCrashes(socket);
    Expected<LoadedStage> loaded = loadObject(object, source);
    if (!loaded) {
        send(socket, Message(Message::Kind::refused).put(loaded.error().message));
        ::_exit(0);
    }
    Message description(Message::Kind::loaded);
    const Stage& stage = loaded->stage;
    put(description, Description{.title = std::string(stage.title),
                                 .news = std::string(stage.news),
                                 .properties = stage.properties(),
                                 .inputs = stage.inputs(),
                                 .camera = stage.camera,
                                 .programs = loaded->programs,
                                 .views = {}});
    description.put(baseOf(object));
    send(socket, description);

    Drawing drawing{.socket = socket,
                    .memory = memory,
                    .stage = loaded->stage,
                    .prepared = {},
                    .files = {},
                    .target = {},
                    .frame = {}};
    std::string bytes;
    while (receive(socket, bytes, true) == Received::message) {
        Message request(std::move(bytes));
        Look look;
        get(request, look);
        const Expected<Drawn> drawn = drawing.draw(look);
        Message answer(drawn ? Message::Kind::drawn : Message::Kind::refused);
        if (drawn) {
            put(answer.put(*drawn), drawing.views());
        } else {
            answer.put(drawn.error().message);
        }
        send(socket, answer);
    }
    ::_exit(0);  // the learner's static destructors are not run
}

// --- the maker ---

void buildAllLevels(const LoadedInputs& inputs)
{
    for (const auto& texture : inputs.textures) {
        if (texture) texture->level(texture->levelCount() - 1);
    }
}

}  // namespace

[[noreturn]] void runMaker(int socket)
{
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // as the program ends, however it ends
    ::signal(SIGCHLD, SIG_IGN);          // nobody waits for renderers
    ::signal(SIGINT, SIG_IGN);           // control-C is the program's, which ends this one
    std::unique_ptr<LoadedInputs> inputs;
    std::string bytes;
    int descriptors[2] = {-1, -1};
    while (receive(socket, bytes, true, descriptors) == Received::message) {
        Message request(std::move(bytes));
        if (request.kind() == Message::Kind::preload) {
            Inputs wanted;
            InputFiles files;
            bool bakes = false;
            get(request, wanted);
            get(request, files);
            request.get(bakes);
            if (bakes) bakedSphere();
            if (Expected<std::unique_ptr<LoadedInputs>> read = loadInputs(wanted, files)) {
                inputs = std::move(*read);
                buildAllLevels(*inputs);
            }
            continue;
        }
        std::string object;
        StageSource source;
        request.get(object).get(source.id).get(source.stem).get(source.folder).get(source.tutorial).get(source.path);
        const pid_t child = ::fork();
        if (child == 0) {
            ::close(socket);
            ::prctl(PR_SET_PDEATHSIG, SIGKILL);
            runRenderer(descriptors[0], descriptors[1], object, source);
        }
        for (const int descriptor : descriptors) ::close(descriptor);
        send(socket, Message(Message::Kind::make).put(child));
    }
    ::_exit(0);
}

}  // namespace relief::samples::live
