// E-35: parallax methods against the surface that they stand for.
#include "common/render.h"
#include "common/screen_quad.h"
#include "experiments.h"
#include "relief/pipeline/target_texture.h"
#include "relief/shading/parallax.h"
#include "small_frame.h"

namespace relief::experiments {

namespace {

using namespace samples;

constexpr std::array kAngles = {30.0, 60.0, 80.0, 87.0};  // of the ray of sight from the normal
constexpr double kStrength = 0.06;                        // the stages'
constexpr float kBias = 0.42f;

// --- the exact hit ---

using Heights = std::function<double(int x, int y)>;  // of a texel, wrapped

// Heights between texels, bilinear, in double: what a sampler reads, as a surface of its own.
struct Surface
{
    int width, height;
    Heights texel;
    double top;  // the height at which the flat surface lies: 1, or 0.5 where heights go up and down from it

    struct Cell
    {
        double a, b, c, d;  // a + b x + c y + d x y, x and y from the lower left texel's centre
    };
    Cell cell(int x, int y) const
    {
        const double h00 = texel(x, y), h10 = texel(x + 1, y), h01 = texel(x, y + 1), h11 = texel(x + 1, y + 1);
        return {h00, h10 - h00, h01 - h00, h11 - h10 - h01 + h00};
    }

    // In units of uv, up.
    double at(const glm::dvec2& uv) const
    {
        const double x = uv.x * width - 0.5, y = uv.y * height - 0.5;
        const Cell k = cell(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
        const double s = x - std::floor(x), t = y - std::floor(y);
        return (k.a + k.b * s + k.c * t + k.d * s * t - top) * kStrength;
    }

    glm::dvec3 normal(const glm::dvec2& uv) const
    {
        const double x = uv.x * width - 0.5, y = uv.y * height - 0.5;
        const Cell k = cell(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
        const double s = x - std::floor(x), t = y - std::floor(y);
        return {-(k.b + k.d * t) * width * kStrength, -(k.c + k.d * s) * height * kStrength, 1.0};
    }

    // Where the ray through the flat surface's uv, coming down from the viewer, first meets the surface: cell by cell,
    // and in each a quadratic, since the heights along a line are one.
    glm::dvec2 hit(const glm::dvec2& uv, const glm::dvec2& tangent) const
    {
        const glm::dvec2 size(width, height), start = (uv + tangent * ((1.0 - top) * kStrength)) * size - 0.5,
                                              pace = -tangent * kStrength * size;  // from height 1 to height 0
        int x = static_cast<int>(std::floor(start.x)), y = static_cast<int>(std::floor(start.y));
        double t = 0.0;
        while (t < 1.0) {
            const auto border = [](double from, double by, int at) {
                return by == 0.0 ? HUGE_VAL : (at + (by > 0.0 ? 1 : 0) - from) / by;
            };
            const double tx = border(start.x, pace.x, x), ty = border(start.y, pace.y, y);
            const double end = std::min({tx, ty, 1.0});
            // The surface above the ray, s after the cell's entry: a + b s + c s^2.
            const Cell k = cell(x, y);
            const glm::dvec2 p = start + pace * t - glm::dvec2(x, y);
            const double a = k.a + k.b * p.x + k.c * p.y + k.d * p.x * p.y - (1.0 - t);
            const double b = k.b * pace.x + k.c * pace.y + k.d * (p.x * pace.y + p.y * pace.x) + 1.0;
            const double c = k.d * pace.x * pace.y;
            const double s = firstRoot(a, b, c);
            if (s <= end - t) return (start + pace * (t + s) + 0.5) / size;
            t = std::max(t, end);
            if (tx <= ty) x += pace.x > 0.0 ? 1 : -1;
            if (ty <= tx) y += pace.y > 0.0 ? 1 : -1;
        }
        return (start + pace + 0.5) / size;
    }

    // The smallest s >= 0 at which a + b s + c s^2 is at least 0; infinite where there is none.
    static double firstRoot(double a, double b, double c)
    {
        if (a >= 0.0) return 0.0;
        const double square = b * b - 4.0 * a * c;
        if (square < 0.0) return HUGE_VAL;
        const double q = -0.5 * (b + std::copysign(std::sqrt(square), b));
        double first = HUGE_VAL;
        for (const double s : {q / c, a / q}) {
            if (s >= 0.0 && s < first) first = s;  // NaN and infinity are no roots
        }
        return first;
    }
};

// --- the methods, in a fragment program ---

enum class Method
{
    none,
    offset,
    limited,
    steep,
    occlusion,
    relief
};

// The uniforms of the stages.
template <Method METHOD>
struct Parallax
{
    Float strength = static_cast<float>(kStrength), bias = kBias, steps = 10.0f;
    int bisections = 5;

    template <class HeightAt>
    float2 operator()(const float3& viewDir, const HeightAt& heightAt) const
    {
        if constexpr (METHOD == Method::offset || METHOD == Method::limited) {
            const Float height = (heightAt(float2(0.0f)) - 0.5f) * strength;
            if constexpr (METHOD == Method::offset) return parallaxOffset(viewDir, height);
            return limitedParallaxOffset(viewDir, height, bias);
        }
        if constexpr (METHOD == Method::steep) return steepParallaxOffset(viewDir, strength, steps, heightAt);
        if constexpr (METHOD == Method::occlusion) return occlusionParallaxOffset(viewDir, strength, steps, heightAt);
        if constexpr (METHOD == Method::relief)
            return reliefParallaxOffset(viewDir, strength, steps, bisections, heightAt);
        return float2(0.0f);
    }
};

// A wall seen from so far away that all rays are parallel: where each pixel's ray meets the flat surface, and how far
// that is moved. Pixels are squares on the screen; on the surface they are longer, the more grazing the view.
template <Method METHOD>
struct WriteOffset
{
    Parallax<METHOD> parallax;
    sampler2D heights;
    float3 viewDir;
    float2 right, up;  // of the picture, in uv

    float4 operator()(ScreenInterpolators i) const
    {
        const float2 uv = right * (i.uv.x - 0.5f) + up * (i.uv.y - 0.5f), dx = ddx(uv), dy = ddy(uv);
        const float2 offset =
            parallax(viewDir, [&](const float2& aside) { return tex2Dgrad(heights, uv + aside, dx, dy).x; });
        return float4(uv, offset);
    }
};

// The ray of sight's direction: so many degrees from the normal, askew to the texels.
struct View
{
    glm::dvec2 along;  // towards the viewer
    double degrees;

    explicit View(double angle) : along(std::sin(0.4), -std::cos(0.4)), degrees(angle) {}
    glm::dvec2 tangent() const { return along * std::tan(degrees * kRadians); }
    glm::dvec3 direction() const
    {
        return glm::dvec3(along * std::sin(degrees * kRadians), std::cos(degrees * kRadians));
    }
};

template <Method METHOD>
void record(Frame& frame, const View& view, const sampler2D& heights, const Parallax<METHOD>& parallax)
{
    const auto lanes = [](const glm::dvec2& v) { return float2(broadcast(glm::vec2(v))); };
    const glm::dvec2 right(-view.along.y, view.along.x);
    const WriteOffset<METHOD> program = {parallax, heights, float3(broadcast(glm::vec3(view.direction()))),
                                         lanes(right), lanes(-view.along / std::cos(view.degrees * kRadians))};
    frame.reset();
    frame.clear({0, 0, 0, 0});
    frame.draw(primitive("quad"), ScreenVertexProgram{}, program);
}

// --- pictures and errors ---

// Stage 5.14's inputs, and where the rays of a picture of this size really end.
class Subject
{
public:
    explicit Subject(int pixels) : side(pixels), stage(*PreparedStage::prepare(**findStage("5.14"))) {}

    sampler2D heights() const
    {
        Framebuffer target = *Framebuffer::create(1, 1, Format::rgba32f);
        Frame frame(target);
        const ParallaxMaterial material = stage.scene(frame, 1, 1, stage.camera()).uniforms();
        sampler2D finest = material.heightMap;
        finest.filter = Filter::bilinear;
        finest.mipmaps = false;
        return finest;
    }

    Surface surface(bool isAround) const
    {
        const Texture& texture = *heights().texture;
        const int w = texture.width(), h = texture.height();
        std::vector<double> all;
        for (int i = 0; i < w * h; ++i) all.push_back(static_cast<double>(texture.texel(i % w, i / w).x));
        const auto wrapped = [](int i, int n) { return ((i % n) + n) % n; };
        return {w, h, [=](int x, int y) { return all[static_cast<std::size_t>(wrapped(y, h) * w + wrapped(x, w))]; },
                isAround ? 0.5 : 1.0};
    }

    // Of every pixel; `isAround`: of heights that go up and down from the flat surface.
    const std::vector<glm::dvec2>& hits(std::size_t angle, bool isAround, std::span<const glm::vec4> pixels)
    {
        std::vector<glm::dvec2>& all = known[isAround ? 1 : 0][angle];
        if (all.empty()) {
            const Surface exact = surface(isAround);
            for (const glm::vec4& p : pixels)
                all.push_back(exact.hit(glm::dvec2(p.x, p.y), View(kAngles[angle]).tangent()));
        }
        return all;
    }

    const int side;

private:
    PreparedStage stage;
    std::array<std::array<std::vector<glm::dvec2>, kAngles.size()>, 2> known;
};

template <Method METHOD>
Outcome outcomeOf(Subject& subject, const Parallax<METHOD>& parallax)
{
    constexpr bool kIsAround = METHOD == Method::offset || METHOD == Method::limited || METHOD == Method::none;
    const Surface surface = subject.surface(kIsAround);
    ErrorSum all, each[kAngles.size()], normals;
    std::int64_t wrong = 0, away = 0;
    for (std::size_t k = 0; k < kAngles.size(); ++k) {
        const View view(kAngles[k]);
        SmallFrame f(subject.side, subject.side);
        record(f.frame, view, subject.heights(), parallax);
        f.frame.run();
        const std::span<const glm::vec4> pixels = f.target.color32f();
        const std::vector<glm::dvec2>& hits = subject.hits(k, kIsAround, pixels);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const glm::vec4& p = pixels[i];
            const glm::dvec2 found(static_cast<double>(p.x) + static_cast<double>(p.z),
                                   static_cast<double>(p.y) + static_cast<double>(p.w));
            const glm::dvec3 apart(found - hits[i], surface.at(found) - surface.at(hits[i]));
            const double distance = glm::length(apart) / kStrength;
            all.add(distance);
            each[k].add(distance);
            wrong += distance > 0.25 ? 1 : 0;
            const glm::dvec3 its = surface.normal(found);
            normals.add(degreesBetween(its, surface.normal(hits[i])));
            const glm::dvec3 v = view.direction();
            away += glm::dot(its, v) < 0.0 ? 1 : 0;
        }
    }
    Outcome outcome(all.result());
    for (std::size_t k = 0; k < kAngles.size(); ++k)
        outcome.facts.push_back({"RMS at " + number(kAngles[k], 0) + " degrees", each[k].result().rms});
    const double share = 100.0 / static_cast<double>(all.result().count);
    outcome.facts.push_back({"elsewhere, %", share * static_cast<double>(wrong)});
    outcome.facts.push_back({"facing away, %", share * static_cast<double>(away)});
    outcome.facts.push_back({"normals, RMS degrees", normals.result().rms});
    return outcome;
}

template <Method METHOD>
void add(Experiment& e, const std::shared_ptr<Subject>& subject, const char* name, const std::string& parameter,
         const Parallax<METHOD>& parallax)
{
    const auto frames = std::make_shared<std::vector<std::shared_ptr<SmallFrame>>>();
    for (const double angle : kAngles) {
        frames->push_back(smallFrame(subject->side, subject->side));
        record(frames->back()->frame, View(angle), subject->heights(), parallax);
    }
    e.variants.push_back({name,
                          parameter,
                          [=] { return outcomeOf(*subject, parallax); },
                          {[=] {
                               for (const auto& f : *frames) f->frame.run();
                           },
                           static_cast<double>(kAngles.size()) * subject->side * subject->side}});
}

// --- surfaces whose hits are known ---

// The farthest that a hit is from where algebra has it, on a ramp of slope 1 in height a texture's width: the ray's
// height is 1 - t, the ramp's (u - tangent.x k t) with k the strength. A ray ends at height 0.
double rampError()
{
    const Surface ramp = {64, 64, [](int x, int) { return (x + 0.5) / 64.0; }, 1.0};
    double worst = 0.0;
    for (const double angle : {10.0, 45.0, 70.0, 85.0}) {
        const glm::dvec2 tangent(std::tan(angle * kRadians), 0.3);
        for (const double u : {0.2, 0.35, 0.6, 0.9}) {
            const double t = std::min(1.0, (1.0 - u) / (1.0 - kStrength * tangent.x));  // u - k T t = 1 - t
            const glm::dvec2 exact = glm::dvec2(u, 0.5) - tangent * (kStrength * t);
            worst = std::max(worst, glm::length(ramp.hit({u, 0.5}, tangent) - exact));
        }
    }
    return worst;
}

// And from where small steps in double find it: the share of rays that differ by more than a step.
double marchError(int rays)
{
    const Subject subject(1);
    const Surface surface = subject.surface(false);
    std::mt19937 random(35);
    int other = 0;
    for (int i = 0; i < rays; ++i) {
        const glm::dvec2 uv(uniform(random), uniform(random)), tangent = View(10.0 + 70.0 * uniform(random)).tangent();
        constexpr int kSteps = 1 << 16;
        int k = 0;
        while (k < kSteps && surface.at(uv - tangent * (kStrength * k / kSteps)) < -kStrength * k / kSteps) ++k;
        const glm::dvec2 exact = surface.hit(uv, tangent), found = uv - tangent * (kStrength * k / kSteps);
        if (glm::length(exact - found) > 1.01 * glm::length(tangent) * kStrength / kSteps) ++other;
    }
    return static_cast<double>(other) / rays;
}

}  // namespace

Experiment parallaxMethods(Effort effort)
{
    Experiment e;
    e.id = "E-35";
    e.title = "Parallax methods";
    e.question =
        "A ray of sight that goes into a relief ends somewhere else than on the flat surface that is drawn. The "
        "reference is that end, found in double on the very heights, cell by cell. How far from it is the point that "
        "a method takes, in units of the relief's depth? 5.10's bricks, by parallel rays, at four angles from the "
        "normal; their finest level, bilinear, by the functions of shading/parallax.h, which a test holds to 5.10 to "
        "5.14. With an offset heights go up "
        "and "
        "down from the flat surface, in a march down from it, and each is compared with what it stands for. "
        "'Elsewhere' are points more than a quarter of "
        "the depth away: mostly on something that is hidden, or behind it. 'Facing away' is what no ray can hit. "
        "Relief is a march of so many steps, and so many bisections. Errors of all angles together are mostly those at "
        "87 degrees.";
    e.item = "pixel";
    e.unit = "depths of the relief";
    const auto subject = std::make_shared<Subject>(effort.samples(128, 24));
    add<Method::none>(e, subject, "none", "", {});
    add<Method::offset>(e, subject, "offset", "", {});
    add<Method::limited>(e, subject, "offset, limited", "", {});
    for (const int steps : {4, 8, 16, 32, 64, 128}) {
        const Float n = static_cast<float>(steps);
        add<Method::steep>(e, subject, "steep", std::to_string(steps), {.steps = n});
    }
    for (const int steps : {4, 8, 16, 32, 64}) {
        const Float n = static_cast<float>(steps);
        add<Method::occlusion>(e, subject, "occlusion", std::to_string(steps), {.steps = n});
    }
    for (const auto& [steps, bisections] : {std::pair{4, 3}, {8, 3}, {8, 5}, {16, 3}, {16, 5}, {32, 5}, {64, 5}}) {
        const Float n = static_cast<float>(steps);
        add<Method::relief>(e, subject, "relief", std::to_string(steps) + " + " + std::to_string(bisections),
                            {.steps = n, .bisections = bisections});
    }
    e.checks.push_back({"the exact hit on a ramp, beside algebra", 1e-12, rampError, 0.0, true});
    const int rays = effort.samples(2000, 50);
    e.checks.push_back({"rays that 65536 steps in double find another hit for, of 1", 0.005,
                        [=] { return marchError(rays); }, 0.0, true});
    e.finding = [](const Rows& rows) {
        const Row &none = rows("none"), &offset = rows("offset"), &limited = rows("offset, limited"),
                  &steep = rows("steep", "16"), &fine = rows("steep", "64"), &occlusion = rows("occlusion", "16"),
                  &relief = rows("relief", "16 + 5"), &finest = rows("relief", "64 + 5");
        const auto rms = [](const Row& row) { return number(row.outcome.error.rms, 2); };
        const auto fact = [](const Row& row, const std::string& name, int digits) {
            return number(row.fact(name), digits);
        };
        const auto at = [&](const Row& row, int degrees) {
            return fact(row, "RMS at " + std::to_string(degrees) + " degrees", degrees < 60 ? 3 : 2);
        };
        const auto times = [&](const Row& row) { return number(row.fastest / none.fastest, 1); };
        return "One look at the heights helps where the view is steep: at 30 degrees the flat picture is " +
               at(none, 30) + " of the depth off, an offset " + at(offset, 30) + ", a limited one " + at(limited, 30) +
               ". At 87 it is worse than nothing: " + at(offset, 87) + " against " + at(none, 87) +
               "; the limit takes that back (" + at(limited, 87) + "), and the depth with it. A march of 16 steps is " +
               at(steep, 30) + " and " + at(steep, 87) + " off. Interpolated, the same 16 are " + at(occlusion, 30) +
               " and " + at(occlusion, 87) + " off, for " + times(occlusion) +
               " times the flat picture's time instead of " + times(steep) + "; with 5 bisections " + at(relief, 30) +
               " and " + at(relief, 87) + ", for " + times(relief) +
               " times. What a bisection mends is not the distance but the side: " + fact(steep, "facing away, %", 1) +
               " % of the points face away from the viewer after a march, " + fact(occlusion, "facing away, %", 1) +
               " % where it is interpolated, " + fact(relief, "facing away, %", 2) +
               " % after 5 bisections, and normals are " + fact(steep, "normals, RMS degrees", 0) + ", " +
               fact(occlusion, "normals, RMS degrees", 0) + " and " + fact(relief, "normals, RMS degrees", 0) +
               " degrees off. What a march has jumped over no search finds: with 64 steps the three are " + rms(fine) +
               ", " + rms(rows("occlusion", "64")) + " and " + rms(finest) + " off, and only more steps help.";
    };
    return e;
}

}  // namespace relief::experiments
