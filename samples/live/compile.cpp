#include "live/compile.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/pattern.h"

extern char** environ;

namespace relief::samples::live {

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begin)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

// What one compiler gets: which part this is, the learner's text under its own name, and what the loader looks for.
//
// Part 0 has what calls the programs, too. In the others nobody calls the stage's function, so no code is made of it.
std::string completeText(const SourceText& source, const Division& division, unsigned part)
{
    const std::string function = stageFunction(source.text);
    std::string text =
        "#include \"live/headers.h\"\n"
        "namespace relief::inline RELIEF_WIDTH::detail {\n"
        "template <class Any> struct Part {\n"
        "    static constexpr unsigned kNumber = " +
        std::to_string(part) +
        ";\n"
        "    static constexpr unsigned owner([[maybe_unused]] std::uint64_t id) {\n"
        "        switch (id) {\n";
    for (const auto& [id, owner] : division.owners) {
        char row[80];
        std::snprintf(row, sizeof row, "            case 0x%llxull: return %u;\n", static_cast<unsigned long long>(id),
                      owner);
        text += row;
    }
    text += "            default: return id % " + std::to_string(division.parts) + ";\n        }\n    }\n};\n}\n";
    if (part > 0) text += "namespace relief::samples {\nstatic Stage " + function + "();\n}\n";
    text += "#line 1 \"" + source.path + "\"\n" + source.text;
    if (part > 0) return text;
    return text +
           "\n#line 1 \"the end of the stage\"\n"
           "using namespace relief;\n"
           "using namespace relief::samples;\n"
           "extern \"C\" {\n"
           "extern Stage (*const relief_stage)();\n"
           "extern const ::relief::detail::CompiledPrograms* const* const relief_programs;\n"
           "Stage (*const relief_stage)() = " +
           function +
           ";\n"
           "const ::relief::detail::CompiledPrograms* const* const relief_programs = "
           "&::relief::detail::compiledPrograms;\n"
           "[[gnu::visibility(\"hidden\")]] void* __dso_handle = nullptr;\n"
           "}\n";
}

}  // namespace

// --- the folder ---

Expected<PrivateFolder> PrivateFolder::create()
{
    const std::filesystem::path parent = std::filesystem::path(liveFolder()) / "objects";
    std::error_code error;
    std::filesystem::create_directories(parent, error);
    // What programs left behind that were killed.
    for (const auto& old : std::filesystem::directory_iterator(parent, error)) {
        const int process = std::atoi(old.path().filename().c_str());
        std::error_code ignored;
        if (process > 0 && ::kill(process, 0) != 0 && errno == ESRCH) std::filesystem::remove_all(old.path(), ignored);
    }
    std::string pattern = (parent / (std::to_string(::getpid()) + "-XXXXXX")).string();
    if (error || ::mkdtemp(pattern.data()) == nullptr) {
        return fail(parent.string() + ": cannot make a folder here for compiled stages (" + std::strerror(errno) +
                    "); make it writable");
    }
    PrivateFolder folder;
    folder.path = pattern;
    folder.owner = ::getpid();
    return folder;
}

PrivateFolder::~PrivateFolder()
{
    std::error_code ignored;
    if (!path.empty() && owner == ::getpid()) std::filesystem::remove_all(path, ignored);
}

// --- the parts ---

unsigned mostParts()
{
    return std::clamp(std::thread::hardware_concurrency(), 1u, 8u);
}

Division divided(const std::vector<std::uint64_t>& programs)
{
    const std::set<std::uint64_t> names(programs.begin(), programs.end());
    Division division;
    if (names.size() != programs.size()) return division;
    division.parts = std::clamp(static_cast<unsigned>(names.size()), 1u, mostParts());
    // Neighbours in the file go to different compilers: they are alike, and so take as long as each other.
    unsigned next = 0;
    for (const std::uint64_t id : programs) division.owners[id] = ++next % division.parts;
    return division;
}

std::string stageFunction(const std::string& text)
{
    static const Pattern pattern(R"((?:^|\n)(?:relief::samples::)?Stage\s+([A-Za-z_]\w*)\s*\(\s*\))");
    const std::vector<Match> all = pattern.find(text);
    return all.empty() ? "" : all.back()[1];
}

// --- the compilers ---

Compile::Compile(const std::string& compiler, const std::vector<std::string>& itsWords, SourceText itsSource,
                 const Division& division, const std::string& folder, int version)
    : source(std::move(itsSource)),
      kept(compiler, itsWords, source),
      compileBegin(std::filesystem::file_time_type::clock::now()),
      stem(folder + "/" + std::to_string(version)),
      begin(Clock::now())
{
    if (stageFunction(source.text).empty()) {
        result.errors = {{.file = source.path,
                          .message = "a stage's file must have a function `Stage NAME()` at the beginning of a line, "
                                     "which gives the stage; `relief new` writes one"}};
        return;
    }
    if (kept.copyTo(stem + ".so")) {
        result.object = stem + ".so";
        return;
    }
    const std::string home = std::filesystem::path(source.path).parent_path().string();
    for (unsigned part = 0; part < division.parts; ++part) {
        const std::string base = stem + "_" + std::to_string(part);
        std::ofstream(base + ".cpp", std::ios::binary) << completeText(source, division, part);
        objects.push_back(base + ".o");
        lists.push_back(base + ".d");
        std::vector<std::string> words = {compiler};
        words.insert(words.end(), itsWords.begin(), itsWords.end());
        words.insert(words.end(), {"-iquote", home.empty() ? "." : home, "-MMD", "-MF", lists.back(), "-c",
                                   base + ".cpp", "-o", objects.back()});
        running.push_back(start(words));
    }
}

Compile::~Compile()
{
    for (Process& process : running) end(process);
}

Compile::Process Compile::start(const std::vector<std::string>& words) const
{
    Process process;
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) return process;
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    // Messages in English: they are read here.
    std::vector<char*> environment;
    std::string language = "LC_ALL=C";
    for (char** e = environ; *e != nullptr; ++e) {
        if (std::strncmp(*e, "LC_", 3) != 0 && std::strncmp(*e, "LANG", 4) != 0) environment.push_back(*e);
    }
    environment.push_back(language.data());
    environment.push_back(nullptr);

    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, ends[1], 1);
    posix_spawn_file_actions_adddup2(&files, ends[1], 2);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    // A group of its own: a compiler starts others, and a newer save ends them all.
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int error =
        ::posix_spawn(&process.id, words[0].c_str(), &files, &attributes, arguments.data(), environment.data());
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    ::close(ends[1]);
    process.output = ends[0];
    if (error != 0) {
        process.id = -1;
        process.status = 1;
        process.printed = words[0] + ": cannot be run (" + std::strerror(error) + ")";
    }
    return process;
}

void Compile::end(Process& process) const
{
    if (process.id > 0) {
        ::kill(-process.id, SIGKILL);
        ::waitpid(process.id, nullptr, 0);
        process.id = -1;
    }
    if (process.output >= 0) ::close(process.output);
    process.output = -1;
}

// Whether it has ended.
bool Compile::read(Process& process) const
{
    char buffer[4096];
    while (process.output >= 0) {
        const ssize_t size = ::read(process.output, buffer, sizeof buffer);
        if (size < 0 && errno == EINTR) continue;
        if (size < 0) return false;  // nothing more yet
        if (size > 0) {
            process.printed.append(buffer, static_cast<std::size_t>(size));
            continue;
        }
        ::close(process.output);
        process.output = -1;
        if (process.id > 0) ::waitpid(process.id, &process.status, 0);
        process.id = -1;
    }
    return true;
}

Compiled Compile::failed(std::string printed)
{
    for (Process& process : running) end(process);
    running.clear();
    result.object.clear();
    result.errors = parseDiagnostics(printed, source.path, source.text);
    if (result.errors.empty()) result.errors = {{.file = source.path, .message = "the compiler failed without a word"}};
    return std::move(result);
}

std::optional<Compiled> Compile::poll()
{
    if (objects.empty()) return std::move(result);  // refused, or not compiled
    bool all = true;
    for (Process& process : running) {
        const bool ended = read(process);
        if (ended && process.status != 0) return failed(std::move(process.printed));
        all = all && ended;
    }
    if (!all) return std::nullopt;
    running.clear();
    if (!linking) {
        result.compileMilliseconds = millisecondsSince(begin);
        begin = Clock::now();
        linking = true;
        // The linker itself: a compiler that calls it takes ten times as long. Whatever is missing is the program's.
        std::vector<std::string> words = {linkerPath(), "-shared", "--eh-frame-hdr", "-Bsymbolic-functions", "-z",
                                          "muldefs",    "-o",      stem + ".so"};
        // A function of the file that is visible elsewhere is in all parts: muldefs.
        words.insert(words.end(), objects.begin(), objects.end());
        running.push_back(start(words));
        return std::nullopt;
    }
    result.linkMilliseconds = millisecondsSince(begin);
    result.object = stem + ".so";
    kept.keep(result.object, lists, compileBegin);
    return std::move(result);
}

std::vector<int> Compile::descriptors() const
{
    std::vector<int> all;
    for (const Process& process : running) {
        if (process.output >= 0) all.push_back(process.output);
    }
    return all;
}

Compiled Compile::wait()
{
    for (;;) {
        if (std::optional<Compiled> done = poll()) return std::move(*done);
        std::vector<pollfd> waiting;
        for (const int descriptor : descriptors()) waiting.push_back({descriptor, POLLIN, 0});
        if (!waiting.empty()) ::poll(waiting.data(), waiting.size(), -1);
    }
}

}  // namespace relief::samples::live
