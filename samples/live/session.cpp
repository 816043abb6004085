#include "live/session.h"
#include "relief/file.h"

#include <algorithm>
#include <set>
#include <sstream>

#include <poll.h>

namespace relief::samples::live {

namespace {

double milliseconds(Watch::Clock::duration time)
{
    return std::chrono::duration<double, std::milli>(time).count();
}

std::string lineOfText(const std::string& text, int line)
{
    std::istringstream stream(text);
    std::string row;
    for (int i = 0; i < line; ++i) std::getline(stream, row);
    return line > 0 ? row : "";
}

bool namesTwice(const std::vector<std::uint64_t>& programs)
{
    return std::set<std::uint64_t>(programs.begin(), programs.end()).size() != programs.size();
}

}  // namespace

Expected<std::unique_ptr<Session>> Session::open(const StageSource& source, const Look& look, Maker& maker,
                                                 const std::string& compiler)
{
    const Expected<const Toolchain*> toolchain = findToolchain(compiler);
    if (!toolchain) return tl::unexpected(toolchain.error());
    const Expected<std::string> text = readText(source.path);
    if (!text) return tl::unexpected(text.error());
    Expected<PrivateFolder> folder = PrivateFolder::create();
    if (!folder) return tl::unexpected(folder.error());
    std::unique_ptr<Session> session(new Session(source, look, maker, **toolchain, std::move(*folder)));
    session->save(*text, Watch::Clock::now());
    return session;
}

Session::Session(const StageSource& source, const Look& look, Maker& itsMaker, const Toolchain& itsToolchain,
                 PrivateFolder itsFolder)
    : itsSource(source),
      wanted(look),
      maker(itsMaker),
      toolchain(itsToolchain),
      folder(std::move(itsFolder)),
      watch(source.path)
{
}

void Session::save(std::string newText, Watch::Clock::time_point noticed)
{
    text = std::move(newText);
    newTimes = {};
    newTimes.notice = milliseconds(Watch::Clock::now() - noticed);
    begin();
}

// A compile that runs, and a version that nobody has seen, are of no use any more.
void Session::begin()
{
    compile.reset();
    incoming.reset();
    replaying = false;
    ++version;
    compile = std::make_unique<Compile>(toolchain.path, toolchain.words, SourceText{itsSource.path, text}, division,
                                        folder.path, version);
}

void Session::look(const Look& look)
{
    wanted = look;
    wanted.strict = strict;
    waiting = true;
    if (!current && !incoming && !lastGood.empty()) {
        if (Expected<std::unique_ptr<Renderer>> again = maker.make(lastGood, itsSource)) current = std::move(*again);
    }
    Renderer* const newest = incoming ? incoming.get() : current.get();
    if (newest != nullptr && !newest->drawing()) {
        newest->draw(wanted);
        waiting = false;
    }
}

void Session::complain(std::vector<Diagnostic> diagnostics, News& news)
{
    trouble = Problem{std::move(diagnostics), false};
    news.problem = true;
}

void Session::compiled(Compiled result, News& news)
{
    compile.reset();
    news.compiling = true;
    newTimes.compile = result.compileMilliseconds;
    newTimes.link = result.linkMilliseconds;
    if (result.object.empty()) return complain(std::move(result.errors), news);
    stamp = Watch::Clock::now();
    Expected<std::unique_ptr<Renderer>> made = maker.make(result.object, itsSource);
    if (!made) return complain({{.file = itsSource.path, .message = made.error().message}}, news);
    incoming = std::move(*made);
    wanted.strict = strict;
    incoming->draw(wanted);
}

void Session::show(const Renderer& renderer, const Drawn& drawn)
{
    const std::span<const std::uint32_t> pixels = renderer.pixels();
    shown.pixels.assign(pixels.begin(), pixels.end());
    shown.drawn = drawn;
    shown.version = currentVersion;
}

// A renderer that is gone: the version before comes back.
void Session::lost(std::unique_ptr<Renderer>& renderer, const Failure& failure, News& news)
{
    const std::string object = renderer->object();
    renderer.reset();
    // A thread whose stack is full cannot say where it is. With one thread all happens where it can be told.
    if (failure.line == 0 && !replaying && wanted.threads != 1) {
        if (Expected<std::unique_ptr<Renderer>> again = maker.make(object, itsSource)) {
            replaying = true;
            renderer = std::move(*again);
            Look alone = wanted;
            alone.threads = 1;
            renderer->draw(alone);
            return;
        }
    }
    replaying = false;
    complain(
        {{.file = itsSource.path,
          .line = failure.line,
          .message = "the compiled stage " + failure.what + (shown.version > 0 ? "; what you see is from before" : ""),
          .source = lineOfText(text, failure.line)}},
        news);
    if (&renderer == &incoming || !previous) return;
    current = std::move(previous);
    currentVersion = previousVersion;
    description = previousDescription;
    lastGood = current->object();
    news.stage = true;
    current->draw(wanted);
}

void Session::hear(std::unique_ptr<Renderer>& renderer, News& news)
{
    Renderer::News heard = renderer->poll();
    if (heard.loaded) {
        (&renderer == &incoming ? incomingDescription : description) = std::move(*heard.loaded);
        if (&renderer == &incoming) {
            const std::vector<std::uint64_t>& programs = incomingDescription->programs;
            if (division.parts > 1 && namesTwice(programs)) {
                division = {.parts = 1, .owners = {}};
                return begin();
            }
            division = divided(programs);
        }
    }
    if (heard.drawn) {
        strict = false;
        replaying = false;
        if (trouble && trouble->isRefusal) {
            trouble.reset();
            news.problem = true;
        }
        if (&renderer == &incoming) {
            previous = std::move(current);
            previousVersion = currentVersion;
            previousDescription = std::move(description);
            current = std::move(incoming);
            currentVersion = version;
            description = std::move(incomingDescription);
            lastGood = current->object();
            maker.preload(description->inputs, wanted.files, text.find("bakedSphere()") != std::string::npos);
            trouble.reset();
            news.stage = news.problem = true;
        }
        show(*current, *heard.drawn);
        news.picture = true;
        if (news.stage) {
            newTimes.draw = heard.drawn->milliseconds;
            newTimes.load = milliseconds(Watch::Clock::now() - stamp) - newTimes.draw;
            lastTimes = newTimes;
        }
        if (description && description->views != heard.views) {
            description->views = std::move(heard.views);
            news.stage = true;
        }
        if (waiting) {
            waiting = false;
            current->draw(wanted);
        }
        return;
    }
    if (heard.failure) return lost(renderer, *heard.failure, news);
    if (heard.refused) {
        complain({{.file = itsSource.path, .message = *heard.refused}}, news);
        trouble->isRefusal = true;  // the renderer goes on: another Look may be better
    }
}

std::vector<int> Session::descriptors() const
{
    std::vector<int> all;
    if (watch.descriptor() >= 0) all.push_back(watch.descriptor());
    if (compile) {
        for (const int descriptor : compile->descriptors()) all.push_back(descriptor);
    }
    for (const Renderer* renderer : {incoming.get(), current.get()}) {
        if (renderer != nullptr) all.push_back(renderer->descriptor());
    }
    return all;
}

std::chrono::milliseconds Session::patience() const
{
    std::chrono::milliseconds longest = watch.patience();
    for (const Renderer* renderer : {incoming.get(), current.get()}) {
        if (renderer != nullptr) longest = std::min(longest, renderer->patience());
    }
    return longest;
}

Session::News Session::update(std::chrono::milliseconds patience)
{
    const auto until = Watch::Clock::now() + patience;
    News news;
    for (;;) {
        if (std::optional<Watch::Change> change = watch.poll()) {
            save(std::move(change->text), change->noticed);
            news.compiling = true;
        }
        if (compile) {
            if (std::optional<Compiled> result = compile->poll()) compiled(std::move(*result), news);
        }
        if (incoming) hear(incoming, news);
        if (current) hear(current, news);
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Watch::Clock::now());
        if (news.any() || left.count() <= 0) return news;

        std::vector<pollfd> waits;
        for (const int descriptor : descriptors()) waits.push_back({descriptor, POLLIN, 0});
        ::poll(waits.data(), waits.size(), static_cast<int>(std::min(left, this->patience()).count()));
    }
}

}  // namespace relief::samples::live
