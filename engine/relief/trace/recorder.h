// What one pixel's, or vertex's, program said, in order.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "relief/bits.h"
#include "relief/trace/sample_trace.h"

namespace relief::inline RELIEF_WIDTH::trace {

// A value of the quad's four pixels: upper left, upper right, lower left, lower right. Of vertices 4k ... 4k + 3.
struct QuadValue
{
    ValueKind kind = ValueKind::number;
    int rows = 1, columns = 1;
    std::array<std::array<std::uint32_t, 16>, 4> words{};  // of each pixel: floats' bits, integers, 0 and 1

    float number(int pixel, int component) const
    {
        const std::uint32_t word = words[static_cast<std::size_t>(pixel)][static_cast<std::size_t>(component)];
        return kind == ValueKind::number ? bitCast<float>(word) : static_cast<float>(static_cast<std::int32_t>(word));
    }
};

// From all lanes; `quad` is its first one.
QuadValue quadOf(const LaneValue& value, int quad);

struct Event
{
    enum class Kind
    {
        enter,
        leave,
        value,
        sample
    };
    Kind kind;
    Site site;
    std::string field;  // of a struct: ".dir"
    QuadValue value;
    std::size_t sample = 0;  // its place in the list of samples
};

// Listens as long as it lives. Every texture's sample is put together again from its texels.
class Recorder final : public Listener
{
public:
    explicit Recorder(int itsLane) : lane(itsLane) { listener = this; }
    ~Recorder() { listener = nullptr; }
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    void enter(const Site& function) override { events.push_back({Event::Kind::enter, function, "", {}}); }
    void leave() override { events.push_back({Event::Kind::leave, {"", 0, "", ""}, "", {}}); }
    void value(const Site& site, const std::string& field, const LaneValue& v) override
    {
        events.push_back({Event::Kind::value, site, field, quadOf(v, lane & ~3)});
    }
    void sample(const Site& site, const TextureCall& call) override;

    std::vector<Event> events;
    std::vector<SampleTrace> textures;
    bool agrees = true;  // all samples did

private:
    int lane;
};

}  // namespace relief::inline RELIEF_WIDTH::trace
