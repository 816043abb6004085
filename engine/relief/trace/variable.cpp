#include "relief/trace/variable.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <mutex>
#include <set>
#include <string_view>
#include <tuple>

#include "relief/pipeline/exchange.h"
#include "relief/pipeline/format.h"

namespace relief::inline RELIEF_WIDTH::trace {

namespace {

enum class Show
{
    range,
    color,
    unit,
    length,
    sign,
    x,
    y,
    z,
    w
};
constexpr std::pair<const char*, Show> kShows[] = {
    {"range", Show::range},   {"colour", Show::color}, {"color", Show::color}, {"unit", Show::unit},
    {"length", Show::length}, {"sign", Show::sign},    {"x", Show::x},         {"y", Show::y},
    {"z", Show::z},           {"w", Show::w}};

struct Wanted
{
    std::string name;
    int line = 0;
    Show show = Show::range;
};

Expected<Wanted> parseVariable(const std::string& view)
{
    const Error error = {"'" + view +
                         "' is no value of a line: write NAME@LINE, such as albedo@81, or with :colour, :unit, "
                         ":length, :sign or :x behind it"};
    const std::size_t at = view.find('@'), colon = view.find(':', at);
    Wanted wanted;
    wanted.name = view.substr(0, at);
    const char* const end = view.data() + std::min(colon, view.size());
    const auto [rest, failure] = std::from_chars(view.data() + at + 1, end, wanted.line);
    if (failure != std::errc() || rest != end || wanted.name.empty()) return tl::unexpected(error);
    if (colon == std::string::npos) return wanted;
    for (const auto& [name, show] : kShows) {
        if (view.substr(colon + 1) == name) {
            wanted.show = show;
            return wanted;
        }
    }
    return tl::unexpected(error);
}

// What a frame's programs tell of all their blocks, on all threads.
struct Told
{
    Wanted wanted;
    Inspection* result = nullptr;
    std::vector<std::optional<NotFinite>>* notFinite = nullptr;  // of each pixel; null: not asked for
    std::mutex mutex;
    std::set<std::tuple<int, std::string>> names;  // by line
    int components = 0;
};

// Listens to one block.
class BlockListener final : public Listener
{
public:
    BlockListener(Told& its, int drawNumber) : told(its), draw(drawNumber) { listener = this; }
    ~BlockListener() { listener = nullptr; }
    BlockListener(const BlockListener&) = delete;
    BlockListener& operator=(const BlockListener&) = delete;

    void enter(const Site&) override {}
    void leave() override {}
    void sample(const Site&, const TextureCall&) override {}
    void value(const Site& site, const std::string& field, const LaneValue& v) override
    {
        if (told.notFinite != nullptr) return lookAt(site, field, v);
        const std::string name = site.name + field;
        if (site.line != told.wanted.line || name != told.wanted.name || v.columns > 1) {
            // Of the shader itself: the engine's files are in folders.
            if (std::string_view(site.file).find('/') == std::string_view::npos)
                isNew |= names.emplace(site.line, name).second;
            return;
        }
        components = v.rows;
        for (int c = 0; c < 4; ++c) values[c] = c < v.rows ? asNumbers(v, c) : Float(0.0f);
    }

    // After the program has run.
    void note(const ShadedBlock& block, bool discards)
    {
        Inspection& result = *told.result;
        const unsigned kept = discards ? block.live & ~block.discarded : block.live;
        for (int lane = 0; lane < kLanes; ++lane) {
            const int x = block.covered.x + laneX(lane), y = block.covered.y + laneY(lane);
            if ((kept >> lane & 1u) == 0 || x >= result.width || y >= result.height) continue;
            const auto pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(result.width) + static_cast<std::size_t>(x);
            if (first[lane]) {
                std::optional<NotFinite>& its = (*told.notFinite)[pixel];
                if (!its) its = *first[lane];
                its->x = x;
                its->y = y;
            }
            if (components == 0) continue;
            for (int c = 0; c < components; ++c) result.values[pixel][c] = values[c][lane];
            result.drawn[pixel] = 1;
        }
        if (!isNew && components == 0) return;
        const std::lock_guard lock(told.mutex);
        told.names.merge(names);
        told.components = std::max(told.components, components);
    }

private:
    static Float asNumbers(const LaneValue& v, int c)
    {
        return v.kind == ValueKind::number ? v.components[c] : Float(asInt(v.components[c]));
    }

    void lookAt(const Site& site, const std::string& field, const LaneValue& v)
    {
        for (int c = 0; c < v.rows * v.columns && v.kind == ValueKind::number; ++c) {
            const Float value = v.components[c];
            if (all(abs(value) <= std::numeric_limits<float>::max())) continue;
            for (int lane = 0; lane < kLanes; ++lane) {
                if (!std::isfinite(value[lane]) && !first[lane])
                    first[lane] = NotFinite{0, 0, draw, site, field, value[lane]};
            }
        }
    }

    Told& told;
    int draw;
    int components = 0;
    bool isNew = false;
    Float values[4];
    std::set<std::tuple<int, std::string>> names;
    std::optional<NotFinite> first[kLanes];
};

struct ToldProgram
{
    OwnProgram own;
    int draw;
    Told* told;
};

void shadeTold(const void* program, std::span<ShadedBlock> blocks, const TriangleBatch& batch,
               const TriangleCorners* corners)
{
    const auto& its = *static_cast<const ToldProgram*>(program);
    for (ShadedBlock& block : blocks) {
        BlockListener hears(*its.told, its.draw);
        its.own.shadeBlocks({&block, 1}, batch, corners);
        hears.note(block, its.own.programs->discards);
    }
}

void runTold(Frame::Storage& storage, Told& told, Inspection& result)
{
    told.result = &result;
    result.width = storage.target.width();
    result.height = storage.target.height();
    result.tileSize = storage.tileSize;
    const std::size_t pixels = static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height);
    result.values.assign(pixels, glm::vec4(0.0f));
    result.drawn.assign(pixels, 0);
    const ExchangedPrograms<ToldProgram> exchanged(
        storage,
        [&](const Draw& draw, const OwnProgram& own) {
            return ToldProgram{own, static_cast<int>(draw.geometry.drawIndex), &told};
        },
        shadeTold);
    result.statistics = storage.run();
}

// As a screen shows a linear colour.
glm::vec4 encoded(const glm::vec4& linear)
{
    const float4 codes = encodeSrgb(saturate(float4(linear)));
    return {codes.x[0], codes.y[0], codes.z[0], linear.w};
}

void showAs(Show show, Inspection& result)
{
    if (show == Show::color) {
        for (glm::vec4& v : result.values) v = encoded(v);
        result.view.unit = "sRGB";
    }
    if (show >= Show::length) {
        for (glm::vec4& v : result.values) {
            const float length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z + v.w * v.w);
            const float component = v[std::clamp(static_cast<int>(show) - static_cast<int>(Show::x), 0, 3)];
            v = glm::vec4(show == Show::length ? length
                          : show == Show::sign ? static_cast<float>(v.x > 0.0f) - static_cast<float>(v.x < 0.0f)
                                               : component);
        }
        result.components = 1;
    }
    result.showAs = result.components == 1 ? ShowAs::scale : ShowAs::vector;
    const auto between = [&](float low, float high) {
        result.lowest = low;
        result.highest = high;
    };
    if (show == Show::color) return between(0.0f, 1.0f);
    if (show == Show::unit || show == Show::sign) return between(-1.0f, 1.0f);
    fitRange(result, false);
}

}  // namespace

Expected<Inspection> inspectVariable(Frame& frame, const std::string& view)
{
    const Expected<Wanted> wanted = parseVariable(view);
    if (!wanted) return tl::unexpected(wanted.error());
    Told told;
    told.wanted = *wanted;
    Inspection result;
    runTold(frame.internals(), told, result);
    if (told.components == 0) {
        std::string names;
        for (const auto& [line, name] : told.names)
            names += (names.empty() ? "" : ", ") + name + "@" + std::to_string(line);
        return fail("no pixel has a value of '" + view + "'; there are " + (names.empty() ? "none" : names));
    }
    result.components = told.components;
    result.view = {view, "as line " + std::to_string(wanted->line) + " gives it", "", Sight::interpolator};
    showAs(wanted->show, result);
    return result;
}

std::optional<NotFinite> firstNotFinite(Frame& frame)
{
    Frame::Storage& storage = frame.internals();
    std::vector<std::optional<NotFinite>> all(static_cast<std::size_t>(storage.target.width()) *
                                              static_cast<std::size_t>(storage.target.height()));
    Told told;
    told.notFinite = &all;
    Inspection result;
    runTold(storage, told, result);
    const auto first = std::find_if(all.begin(), all.end(), [](const auto& its) { return its.has_value(); });
    if (first == all.end()) return {};
    return *first;
}

}  // namespace relief::inline RELIEF_WIDTH::trace
