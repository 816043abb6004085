// E-36: filters and biases of shadow maps against rays.
#include "common/render.h"
#include "experiments.h"
#include "relief/mesh/ray_tree.h"
#include "relief/pipeline/target_texture.h"
#include "relief/shading/shadows.h"
#include "small_frame.h"

namespace relief::experiments {

namespace {

using namespace samples;

constexpr float kMapWidth = 4.4f;  // what the map covers, in units of the world: the stages'
constexpr float kConstantSteps = 60000.0f;
constexpr double kAwayFromEdges = 0.06;  // units: three texels of a map of 256

// --- programs ---

struct VertexData
{
    POSITION position;
    NORMAL normal;
};

struct DepthInterpolators
{
    SV_POSITION position;
};
struct DepthVertexProgram
{
    ObjectTransform object;
    DepthInterpolators operator()(VertexData v) const { return {UnityObjectToClipPos(object, v.position)}; }
};
struct NoColor
{
    float4 operator()(DepthInterpolators) const { return float4(0.0f); }
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float3> normal;
    TEXCOORD<1, float3> worldPos;
};
struct VertexProgram
{
    ObjectTransform object;
    Interpolators operator()(VertexData v) const
    {
        return {UnityObjectToClipPos(object, v.position), UnityObjectToWorldNormal(object, v.normal),
                mul(object.worldFromObject, v.position).xyz()};
    }
};

// TAPS as in filteredShadow; 0: one texel.
template <int TAPS>
struct WriteShadow
{
    float4x4 lightFromWorld;
    sampler2D depths;
    Float offset;  // along the normal

    float4 operator()(Interpolators i) const
    {
        const float3 worldPos = i.worldPos + normalize(i.normal) * offset;
        const float4 p = mul(lightFromWorld, float4(worldPos, 1));
        const float2 uv = p.xy() * 0.5f + 0.5f;
        if constexpr (TAPS == 0)
            return float4(shadowOfOneTexel(depths, uv, p.z));
        else
            return float4(filteredShadow<TAPS>({depths.texture}, uv, p.z));
    }
};

// Where a pixel's surface is, and in w how far the triangle itself leans towards the light: its cosine.
struct WritePlace
{
    float3 light;

    float4 operator()(Interpolators i) const
    {
        const float3 plane = normalize(cross(ddx(i.worldPos), ddy(i.worldPos)));
        const Float cosine = dot(plane, light) * select(dot(plane, i.normal) < 0.0f, Float(-1.0f), Float(1.0f));
        return float4(i.worldPos, cosine);
    }
};

// --- the scene of stage 5.06, and its exact shadows ---

struct Sun : Uniforms
{
    UnityLight light = sun(38.0f, -50.0f);
};

class Subject
{
public:
    Subject(int pixelsWide, int pixelsHigh)
        : width(pixelsWide), height(pixelsHigh), stage(*PreparedStage::prepare(**findStage("5.06")))
    {
        SmallFrame f(1, 1);
        const Sun itsSun = stage.scene(f.frame, 1, 1, stage.camera()).uniforms();
        light = firstLane(itsSun.light.dir);
        lightFromWorld = orthographic(kMapWidth, kMapWidth, 1.0f, 6.0f) * lookAt(light * 3.5f, glm::vec3(0));
        const Camera& camera = stage.camera();
        clipFromWorld =
            clipFromView(camera, static_cast<float>(width) / static_cast<float>(height)) * viewFromWorld(camera);
    }

    const std::vector<Object>& objects() const { return stage.inputs->objects; }

    template <class Vertex, class Fragment>
    void draw(Frame& frame, const glm::mat4& seenFrom, const Fragment& fragment, const RenderState& state) const
    {
        for (const Object& o : objects())
            frame.draw(*o.mesh, Vertex{ObjectTransform(seenFrom, o.worldFromObject)}, fragment, state);
    }

    // A pixel that is judged: its surface faces the light.
    struct Point
    {
        std::size_t pixel;
        bool isLit, isAwayFromEdges;
    };
    const std::vector<Point>& points()
    {
        if (!known.empty()) return known;
        SmallFrame f(width, height);
        f.frame.clear(glm::vec4(0.0f));
        draw<VertexProgram>(f.frame, clipFromWorld, WritePlace{float3(broadcast(light))}, {});
        f.frame.run();
        const RayTree tree(casters());
        const glm::dvec3 towards = glm::normalize(glm::dvec3(light));
        const glm::dvec3 aside = glm::normalize(glm::cross(towards, glm::dvec3(0, 1, 0))),
                         up = glm::cross(aside, towards);
        const auto isLit = [&](const glm::dvec3& from) { return !tree.firstHit({from, towards, 1e-4, 20.0}); };
        const std::span<const glm::vec4> places = f.target.color32f();
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (places[i].w < 0.02f) continue;  // background: 0
            const glm::dvec3 p(places[i]);
            Point point = {i, isLit(p), true};
            for (int k = 0; k < 8; ++k) {
                const double turn = k * std::numbers::pi / 4.0;
                const glm::dvec3 beside = (aside * std::cos(turn) + up * std::sin(turn)) * kAwayFromEdges;
                point.isAwayFromEdges = point.isAwayFromEdges && isLit(p + beside) == point.isLit;
            }
            known.push_back(point);
        }
        return known;
    }

    const int width, height;
    glm::vec3 light;
    glm::mat4 lightFromWorld, clipFromWorld;

private:
    // The solids in one mesh. The floor's front faces hide nothing.
    Mesh casters() const
    {
        Mesh all;
        all.name = "casters";
        for (const Object& o : objects()) {
            const auto first = static_cast<std::uint32_t>(all.positions.size());
            for (const glm::vec3& p : o.mesh->positions)
                all.positions.push_back(glm::vec3(o.worldFromObject * glm::vec4(p, 1.0f)));
            for (const std::uint32_t k : o.mesh->indices) all.indices.push_back(first + k);
        }
        return all;
    }

    PreparedStage stage;
    std::vector<Point> known;
};

// --- a frame: the map, and the picture that asks it ---

enum class Bias
{
    none,
    constant,
    slope,
    normal,
    half  // of slope and normal, each
};

struct Choice
{
    int side;
    Bias bias;
};

// How many texels from its own a filter compares: half a texel, since the surface is sampled at its centre, and the
// filter's own reach. 1.5 for SampleCmp.
template <int TAPS>
constexpr float kReach = TAPS == 0 ? 0.5f : 1.0f + static_cast<float>(TAPS) * 0.5f;

template <int TAPS>
class ShadowFrame
{
public:
    ShadowFrame(const Subject& drawn, Choice how)
        : subject(drawn),
          choice(how),
          map(*Framebuffer::create(how.side, how.side, {{Format::depth32f}})),
          picture(
              *Framebuffer::create(drawn.width, drawn.height, {{Format::r32f}, {Format::depth32f, Store::discard}})),
          mapFrame(map, {.threads = 1}),
          pictureFrame(picture, {.threads = 1})
    {
    }

    void run()
    {
        const float texel = kMapWidth / static_cast<float>(choice.side), reach = kReach<TAPS>;
        RenderState state;
        float offset = 0.0f;
        if (choice.bias == Bias::constant) state.depthBias.constant = kConstantSteps;
        if (choice.bias == Bias::slope) state.depthBias.slope = reach;
        if (choice.bias == Bias::normal) offset = reach * texel;
        if (choice.bias == Bias::half) state.depthBias.slope = reach * 0.5f, offset = reach * texel * 0.5f;
        mapFrame.reset();
        mapFrame.clearDepth();
        subject.template draw<DepthVertexProgram>(mapFrame, subject.lightFromWorld, NoColor{}, state);
        mapFrame.run();
        depths.emplace(*textureOf(map, map.depthIndex()));
        pictureFrame.reset();
        pictureFrame.clear(glm::vec4(0.0f));
        const sampler2D nearest = {.texture = &*depths,
                                   .filter = Filter::nearest,
                                   .u = AddressMode::clamp,
                                   .v = AddressMode::clamp,
                                   .mipmaps = false};
        subject.template draw<VertexProgram>(
            pictureFrame, subject.clipFromWorld,
            WriteShadow<TAPS>{broadcast(subject.lightFromWorld), nearest, Float(offset)}, {});
        pictureFrame.run();
    }

    std::span<const float> shadows() const { return picture.colorR32f(); }

private:
    const Subject& subject;
    Choice choice;
    Framebuffer map, picture;
    Frame mapFrame, pictureFrame;
    std::optional<Texture> depths;
};

template <int TAPS>
Outcome outcomeOf(Subject& subject, Choice choice)
{
    ShadowFrame<TAPS> frame(subject, choice);
    frame.run();
    ErrorSum all;
    double dark = 0.0, lit = 0.0, acne = 0.0, leak = 0.0;
    for (const Subject::Point& p : subject.points()) {
        const double shadow = static_cast<double>(frame.shadows()[p.pixel]), error = p.isLit ? 1.0 - shadow : shadow;
        all.add(error);
        (p.isLit ? dark : lit) += error;
        if (p.isAwayFromEdges) (p.isLit ? acne : leak) += error;
    }
    const double share = 100.0 / static_cast<double>(subject.points().size());
    return {all.result(),
            {{"wrongly dark, %", share * dark},
             {"wrongly lit, %", share * lit},
             {"dark away from edges, %", share * acne},
             {"lit away from edges, %", share * leak},
             {"KiB of the map", choice.side * choice.side * 4.0 / 1024.0}}};
}

template <int TAPS>
void add(Experiment& e, const std::shared_ptr<Subject>& subject, const char* filter, const std::vector<int>& sides)
{
    constexpr std::array kBiases = {"no bias", "constant", "by slope", "along the normal", "half of both"};
    for (const int side : sides) {
        for (std::size_t k = 0; k < kBiases.size(); ++k) {
            const Choice choice = {side, static_cast<Bias>(k)};
            const auto frame = std::make_shared<ShadowFrame<TAPS>>(*subject, choice);
            e.variants.push_back(
                {kBiases[k],
                 std::string(filter) + ", " + std::to_string(side),
                 [=] { return outcomeOf<TAPS>(*subject, choice); },
                 {[subject, frame] { frame->run(); }, static_cast<double>(subject->width) * subject->height}});
        }
    }
}

// --- rays whose shadows are known ---

// A square's shadow on the floor, by a light at an angle: the share of points that differ from what two inequalities
// say.
double squareError()
{
    Mesh square;
    square.name = "square";
    square.positions = {{-0.5f, 1.0f, -0.5f}, {0.5f, 1.0f, -0.5f}, {0.5f, 1.0f, 0.5f}, {-0.5f, 1.0f, 0.5f}};
    square.indices = {0, 1, 2, 0, 2, 3};  // seen from below: its front faces hide the light
    const RayTree tree(square);
    const glm::dvec3 light = glm::normalize(glm::dvec3(0.5, 1.0, 0.25));
    int other = 0;
    std::mt19937 random(36);
    for (int i = 0; i < 10000; ++i) {
        const glm::dvec3 p(2.0 * uniform(random) - 1.5, 0.0, 2.0 * uniform(random) - 1.25);
        const bool isDark = std::abs(p.x + 0.5) < 0.5 && std::abs(p.z + 0.25) < 0.5;
        other += tree.firstHit({p, light, 1e-4, 20.0}).has_value() != isDark ? 1 : 0;
    }
    return other / 10000.0;
}

}  // namespace

Experiment shadowMaps(Effort effort)
{
    Experiment e;
    e.id = "E-36";
    e.title = "Filters and biases of shadow maps";
    e.question =
        "A shadow map answers by its texels, and a surface shadows itself without a bias. The reference is a ray in "
        "double from each pixel's point to the light. By how much is the share of light off, over the pixels whose "
        "surface faces the light? Stage 5.06's scene; one texel, the weighted comparison of 2x2, and 3x3 and 5x5 of "
        "those, by the functions of shading/shadows.h. A bias is as large as the filter needs: by slope and along the "
        "normal by as many texels as it reaches, 0.5, 1.5, 2.5 and 3.5; the constant is 60000 steps of a float, "
        "0.018 units. 'Half of both' is half of each of those two. The numbers are the map's side in texels. The last "
        "errors are without pixels within 0.06 units "
        "of a shadow's edge: what is dark there is acne, what is lit there is light that leaks under an object. Soft "
        "edges count as errors, since the light is a point. Times are of the frame: map and picture.";
    e.item = "pixel";
    e.unit = "shares of the light";
    const auto subject = std::make_shared<Subject>(effort.samples(480, 96), effort.samples(270, 54));
    const std::vector<int> sides = effort.full ? std::vector<int>{128, 512, 2048} : std::vector<int>{128, 512};
    add<0>(e, subject, "one texel", sides);
    add<1>(e, subject, "2x2", sides);
    add<3>(e, subject, "3x3", sides);
    add<5>(e, subject, "5x5", sides);
    e.checks.push_back({"points in a square's shadow that rays have wrong, of 1", 0.0, squareError, 0.0});
    e.finding = [](const Rows& rows) {
        const Row &best = rows("half of both", "2x2, 512"), &wide = rows("half of both", "5x5, 512"),
                  &small = rows("half of both", "2x2, 128");
        const auto rms = [](const Row& row) { return number(row.outcome.error.rms, 3); };
        const auto dark = [&](const char* bias, const char* parameter) {
            return number(rows(bias, parameter).fact("wrongly dark, %"), 2);
        };
        const auto fact = [](const Row& row, const char* name) { return number(row.fact(name), 2); };
        std::string text =
            "Without a bias " + dark("no bias", "2x2, 512") +
            " % of what faces the light is dark, by 2x2 on 512 texels (" + dark("no bias", "2x2, 128") +
            " on 128): more texels make the stripes finer, not fewer. A constant leaves " +
            dark("constant", "2x2, 128") + " % dark on 128 texels and " + dark("constant", "2x2, 512") +
            " on 512: it fits one map. A bias by slope leaves " + dark("by slope", "2x2, 128") + " and " +
            dark("by slope", "2x2, 512") + ", one along the normal " + dark("along the normal", "2x2, 128") + " and " +
            dark("along the normal", "2x2, 512") + ", and half of both " + dark("half of both", "2x2, 128") + " and " +
            dark("half of both", "2x2, 512") +
            " with the same reach: what one of them misses the other finds. A wider filter is softer, not more exact: "
            "with half of both 2x2 is " +
            rms(best) + " off, 3x3 " + rms(rows("half of both", "3x3, 512")) + " and 5x5 " + rms(wide) + ", in " +
            number(wide.fastest / best.fastest, 1) +
            " times the time of 2x2; and since its bias grows with it, light leaks under objects: " +
            fact(rows("by slope", "5x5, 128"), "lit away from edges, %") + " % of the points by slope on 128 texels, " +
            fact(rows("by slope", "2x2, 128"), "lit away from edges, %") +
            " with 2x2. One texel alone, yes or no, is " + rms(rows("half of both", "one texel, 512")) +
            " off. On 128 texels 2x2 is " + rms(small) + " off";
        for (const Row& row : rows.all) {
            if (row.name == "half of both" && row.parameter == "2x2, 2048")
                text += ", on 2048 " + rms(row) + ", for " + number(row.fastest / small.fastest, 0) +
                        " times the time of the frame and 256 times the memory";
        }
        return text + ".";
    };
    return e;
}

}  // namespace relief::experiments
