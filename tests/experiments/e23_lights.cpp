// E-23: light per vertex or per fragment, in one pass or added up in a target of few bits.
#include <algorithm>
#include <random>

#include "experiments.h"
#include "relief/pipeline/output_merger.h"
#include "relief/shading/lights.h"
#include "small_frame.h"

namespace relief::experiments {

namespace {

constexpr int kSize = 128, kMostLights = 16;
constexpr RenderState kFirst = {.depthTest = Compare::always, .depthWrite = false, .cull = Cull::none};
constexpr RenderState kAdded = {
    .depthTest = Compare::always, .depthWrite = false, .cull = Cull::none, .blend = Blend::additive};

// A light over the plane z = 0, on which x and y run from -1 to 1.
struct LightOver
{
    double x, y, height, range, color[3];
};

std::vector<LightOver> lightsOver(int count, double height)
{
    std::mt19937 random(23);
    const auto between = [&random](double low, double high) { return low + (high - low) * uniform(random); };
    std::vector<LightOver> all;
    for (int i = 0; i < count; ++i) {
        LightOver& light = all.emplace_back();
        light.x = between(-0.7, 0.7), light.y = between(-0.7, 0.7);
        light.height = height, light.range = 4.0;
        for (double& c : light.color) c = between(0.3, 0.9) / count;  // the sum stays below 1
    }
    return all;
}

struct Lights
{
    PointLight all[kMostLights];
    int count = 0;

    explicit Lights(const std::vector<LightOver>& from, std::size_t begin, std::size_t end)
    {
        for (std::size_t i = begin; i < end; ++i) {
            const LightOver& l = from[i];
            all[count++] = {float3(l.color[0], l.color[1], l.color[2]), float3(l.x, l.y, -l.height), Float(l.range)};
        }
    }
    // The diffuse light that arrives at a point of the plane.
    float3 at(const float3& worldPos) const
    {
        float3 sum(Float(0.0f));
        for (int i = 0; i < count; ++i) {
            const UnityLight light = CreateLight(all[i], worldPos);
            sum += light.color * max(dot(light.dir, float3(0, 0, -1)), Float(0.0f));
        }
        return sum;
    }
};

struct VertexData
{
    POSITION position;
};
struct Place
{
    SV_POSITION position;
    TEXCOORD<0, float3> worldPos;
};
struct Colored
{
    SV_POSITION position;
    COLOR<0, float3> color;
};

struct PlaceProgram
{
    Place operator()(VertexData v) const
    {
        return {.position = float4(v.position.xyz(), 1.0f), .worldPos = v.position.xyz()};
    }
};
struct LightPerVertex
{
    Lights lights;
    Colored operator()(VertexData v) const
    {
        return {.position = float4(v.position.xyz(), 1.0f), .color = lights.at(v.position.xyz())};
    }
};
struct LightPerFragment
{
    Lights lights;
    float4 operator()(Place i) const { return float4(lights.at(i.worldPos), 1.0f); }
};
struct ShowColor
{
    float4 operator()(Colored i) const { return float4(i.color, 1.0f); }
};

// What arrives at a pixel's centre, in doubles.
double exactly(const std::vector<LightOver>& lights, int x, int y, int channel)
{
    double sum = 0.0;
    for (const LightOver& l : lights) {
        const double dx = l.x - ((x + 0.5) * 2.0 / kSize - 1.0), dy = l.y - (1.0 - (y + 0.5) * 2.0 / kSize);
        const double square = dx * dx + dy * dy + l.height * l.height, part = square / (l.range * l.range);
        const double fade = std::clamp((1.0 - std::sqrt(part)) * 5.0, 0.0, 1.0);
        sum += l.color[channel] * l.height / std::sqrt(square) * fade / (1.0 + 25.0 * part);
    }
    return sum;
}

// How a picture is made: a mesh of so many cells a side, each pass added to the one before.
struct Way
{
    std::string name, parameter;
    int lights, cells;
    bool perVertex, inPasses;
    int bits;  // of a channel: 8, 16 or 32 (float)
    double height = 0.25;
};

// A target's frames and the mesh they draw. Of 16 bits the engine has none: after each pass the floats are rounded.
struct Picture
{
    Way way;
    std::vector<LightOver> lights;
    Mesh mesh;
    std::shared_ptr<Framebuffer> target;
    std::vector<std::unique_ptr<Frame>> frames;  // one, or one a pass for 16 bits

    explicit Picture(const Way& w) : way(w), lights(lightsOver(w.lights, w.height)), mesh(flatGrid(w.cells))
    {
        const Format format = way.bits == 8 ? Format::rgba8 : Format::rgba32f;
        target = std::make_shared<Framebuffer>(std::move(*Framebuffer::create(kSize, kSize, format, Store::keep)));
        const std::size_t step = way.inPasses ? 1 : lights.size();
        for (std::size_t i = 0; i < lights.size(); i += step) {
            if (i == 0 || way.bits == 16)
                frames.push_back(std::make_unique<Frame>(*target, FrameOptions{.threads = 1}));
            const Lights part(lights, i, i + step);
            if (i == 0) frames.back()->clear({0, 0, 0, 1});
            if (way.perVertex) {
                frames.back()->draw(mesh, LightPerVertex{part}, ShowColor{}, kFirst);
            } else if (i == 0) {
                frames.back()->draw(mesh, PlaceProgram{}, LightPerFragment{part}, kFirst);
            } else {
                frames.back()->draw(mesh, PlaceProgram{}, LightPerFragment{part}, kAdded);
            }
        }
    }

    void run() const
    {
        for (const std::unique_ptr<Frame>& frame : frames) {
            frame->run();
            if (way.bits != 16) continue;
            for (glm::vec4& c : target->color32f()) {
                for (int i = 0; i < 4; ++i) c[i] = std::floor(c[i] * 65535.0f + 0.5f) / 65535.0f;
            }
        }
    }

    double channelAt(int x, int y, int channel) const
    {
        const auto at = static_cast<std::size_t>(y * kSize + x);
        if (way.bits == 8) return target->color8()[at] >> (8 * channel) & 255u;
        return 255.0 * static_cast<double>(target->color32f()[at][channel]);
    }

    Error error() const
    {
        ErrorSum sum;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                for (int c = 0; c < 3; ++c) sum.add(channelAt(x, y, c) - 255.0 * exactly(lights, x, y, c));
            }
        }
        return sum.result();
    }
};

Error errorOf(const Way& way)
{
    const Picture picture(way);
    picture.run();
    return picture.error();
}

Variant variant(const Way& way)
{
    const auto picture = std::make_shared<Picture>(way);
    const auto outcome = [picture] {
        picture->run();
        const Way& w = picture->way;
        Outcome result(picture->error(), {{"lights", static_cast<double>(w.lights)},
                                          {"vertices", static_cast<double>(picture->mesh.positions.size())},
                                          {"bytes a pixel", w.bits / 2.0}});
        if (w.bits != 8) result.imageHash = hashOf(*picture->target);
        return result;
    };
    return {way.name, way.parameter, outcome, {[picture] { picture->run(); }, static_cast<double>(kSize * kSize)}};
}

// Of sums that are rounded to 8 bits by the output merger after each of so many random amounts.
double errorOfRandomSums(int passes)
{
    std::mt19937 random(16);
    ErrorSum sum;
    const double codesEach = std::floor(255.0 / passes);
    for (int i = 0; i < (1 << 16) / kLanes; ++i) {
        float amounts[kLanes];
        double exact[kLanes] = {};
        Int codes = 0;
        for (int pass = 0; pass < passes; ++pass) {
            for (int lane = 0; lane < kLanes; ++lane) {
                amounts[lane] = static_cast<float>(codesEach / 255.0 * uniform(random));
                exact[lane] += static_cast<double>(amounts[lane]);
            }
            codes = codeOf(saturate(unpackRgba8(codes).x + Float::load(amounts)));
        }
        for (int lane = 0; lane < kLanes; ++lane) sum.add(codes[lane] - 255.0 * exact[lane]);
    }
    return sum.result().rms;
}

double attenuation(double partOfRange)
{
    VertexLights lights;
    lights.positionX = lights.positionY = float4(0.0f);
    lights.positionZ = float4(Float(partOfRange * 4.0));
    lights.attenSq = float4(25.0f / 16.0f);
    for (float3& color : lights.color) color = float3(0.0f);
    lights.color[0] = float3(1.0f);
    return Shade4PointLights(lights, float3(0.0f), float3(0, 0, 1)).x[0];
}

}  // namespace

Experiment lights(Effort)
{
    Experiment e;
    e.id = "E-23";
    e.title = "Lights: where and how they are added up";
    e.question =
        "A light computed at vertices costs little, and is interpolated; on large triangles its highlight is missing. "
        "Several lights can be summed up in one shader, or each in a pass of its own that is added to the target, "
        "which rounds every sum. How many codes of 8 bits does each cost, on a plane of 128 x 128 pixels?";
    e.item = "pixel";
    e.unit = "8-bit codes";
    e.rivals = Rivals::ofOneParameter;
    for (const int cells : {1, 4, 16, 64}) {
        const std::string n = std::to_string(cells);
        e.variants.push_back(variant({"per vertex " + n + " x " + n, "4 lights", 4, cells, true, false, 32}));
    }
    e.variants.push_back(variant({"per fragment", "4 lights", 4, 1, false, false, 32}));
    for (const int count : {2, 4, 8, 16}) {
        const std::string name = std::to_string(count) + " lights";
        e.variants.push_back(variant({"one pass, 8 bits", name, count, 1, false, false, 8}));
        e.variants.push_back(variant({"passes, 8 bits", name, count, 1, false, true, 8}));
        e.variants.push_back(variant({"passes, 16 bits", name, count, 1, false, true, 16}));
        e.variants.push_back(variant({"passes, float", name, count, 1, false, true, 32}));
    }

    struct Reference
    {
        int passes;
        double rms;
    };
    for (const Reference& r : {Reference{2, .408248}, {4, .577350}, {8, .816497}, {16, 1.15470}}) {
        const std::string name = std::to_string(r.passes) + " passes, ";
        e.checks.push_back({name + "8 bits, RMS, amounts of light at random", r.rms,
                            [=] { return errorOfRandomSums(r.passes); }, 0.02 * r.rms});
        e.checks.push_back({name + "16 bits, RMS", r.rms / 257.0,
                            [=] {
                                return errorOf({"", "", r.passes, 1, false, true, 16}).rms;
                            },
                            0.02 * r.rms / 257.0});
        for (const int bits : {8, 16}) {
            const double bound = (bits == 8 ? 1.0 : 1.0 / 257.0) * r.passes / 2.0 + 1e-4;
            Check largest = {name + std::to_string(bits) + " bits, largest", bound,
                             [=] {
                                 return errorOf({"", "", r.passes, 1, false, true, bits}).max;
                             },
                             0.0};
            largest.isBound = true;
            e.checks.push_back(largest);
        }
    }
    for (const double height : {0.1, 0.25, 0.5}) {
        for (int cells = 2; cells <= 64; cells *= 2) {
            const auto ofCells = [=](int n) { return errorOf({"", "", 4, n, true, false, 32, height}).rms; };
            Check finer = {"per vertex, RMS of " + std::to_string(cells) + " cells against half as many, lights at " +
                               number(height, 2),
                           1.0, [=] { return ofCells(cells) / ofCells(cells / 2); }, 0.0};
            finer.isBound = true;
            e.checks.push_back(finer);
        }
    }
    e.checks.push_back({"a vertex light at half its range", .137931, [] { return attenuation(0.5); }, 1e-6});
    e.checks.push_back({"a vertex light at its range", .0384615, [] { return attenuation(1.0); }, 1e-6});

    e.finding = [](const Rows& rows) {
        const Row &coarse = rows("per vertex 1 x 1", "4 lights"), &fine = rows("per vertex 64 x 64", "4 lights"),
                  &fragment = rows("per fragment", "4 lights"), &passes = rows("passes, 8 bits", "16 lights"),
                  &once = rows("one pass, 8 bits", "16 lights");
        return "Per vertex on two triangles four lights are wrong by up to " + number(coarse.outcome.error.max, 0) +
               " codes; on 64 x 64 cells by " + number(fine.outcome.error.max, 2) + ", and then the vertices make it " +
               (fine.fastest < 0.97 * fragment.fastest ? "still faster" : "no faster") + " than per fragment (" +
               number(fine.fastest, 1) + " against " + number(fragment.fastest, 1) +
               " ns a pixel). 16 passes into 8 bits are wrong by up to " + number(passes.outcome.error.max, 1) +
               " codes, " + number(passes.outcome.error.rms, 2) +
               " RMS (1.15 if roundings were independent; a faint light loses the same all over the picture), and "
               "take " +
               number(passes.fastest, 1) + " ns; all lights in one shader round once (" +
               number(once.outcome.error.rms, 2) + " RMS) and take " + number(once.fastest, 1) + ".";
    };
    return e;
}

}  // namespace relief::experiments
