// E-33: the choices together, in a whole frame: stage 1.25 at several resolutions, with every filter, lighting model
// and way to decode normals.
#include "common/render.h"
#include "exact_srgb.h"
#include "experiments.h"

namespace relief::experiments {

namespace {

using namespace samples;

enum class Lighting
{
    unity,
    exact,
    blinnPhong
};
enum class Decode
{
    root,
    oneMinusHalf,
    one
};

struct VertexData
{
    POSITION position;
    NORMAL normal;
    TANGENT tangent;
    TEXCOORD<0, float2> uv;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float4> uv;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float3> tangent;
    TEXCOORD<3, float3> binormal;
    TEXCOORD<4, float3> worldPos;
};

// As in stage 1.25, with the binormal per vertex.
struct VertexProgram : DetailedMarble
{
    Interpolators operator()(VertexData v) const
    {
        Interpolators i;
        i.position = UnityObjectToClipPos(object, v.position);
        i.worldPos = mul(object.worldFromObject, v.position).xyz();
        i.normal = UnityObjectToWorldNormal(object, v.normal);
        i.tangent = UnityObjectToWorldDir(object, v.tangent.xyz());
        i.binormal = CreateBinormal(i.normal, i.tangent, v.tangent.w, object.unity_WorldTransformParams.w);
        i.uv = float4(TRANSFORM_TEX(v.uv, mainTex_ST), TRANSFORM_TEX(v.uv, detailTex_ST));
        return i;
    }
};

// As in stage 1.25, but with a choice of how normals are decoded and lit. A branch on a uniform costs next to nothing.
template <class Light>
struct FragmentProgram : DetailedMarble
{
    Lighting lighting = {};
    Decode decode = {};
    Light source = {};

    float3 decoded(const float4& texel, Float scale) const
    {
        const float3 n = UnpackScaleNormal(texel, scale);
        if (decode == Decode::root) return n;
        if (decode == Decode::one) return {n.x, n.y, Float(1.0f)};
        return {n.x, n.y, 1.0f - (n.x * n.x + n.y * n.y) * 0.5f};
    }

    float4 lit(const float3& albedo, const float3& specular, const float3& n, const float3& viewDir,
               const UnityLight& received) const
    {
        if (lighting == Lighting::unity) return UNITY_BRDF_PBS(albedo, specular, smoothness, n, viewDir, received);
        if (lighting == Lighting::exact)
            return UNITY_BRDF_PBS_Exact(albedo, specular, smoothness, n, viewDir, received);
        const Float p = 1.0f - smoothness, a = max(p * p, Float(0.002f)), exponent = 2.0f / (a * a) - 2.0f;
        const Float NdotL = saturate(dot(n, received.dir)), NdotH = saturate(dot(n, normalize(received.dir + viewDir)));
        return float4(
            (albedo + specular * ((exponent + 8.0f) * 0.125f * pow(NdotH, exponent))) * received.color * NdotL, 1.0f);
    }

    float4 operator()(Interpolators i) const
    {
        const float3 mainNormal = decoded(tex2D(normalMap, i.uv.xy()), bumpScale);
        const float3 detailNormal = decoded(tex2D(detailNormalMap, i.uv.zw()), detailBumpScale);
        const float3 bump = BlendNormals(mainNormal, detailNormal);
        const float3 n = normalize(i.tangent * bump.x + i.binormal * bump.y + i.normal * bump.z);
        float3 albedo = tex2D(mainTex, i.uv.xy()).xyz() * tint.xyz();
        albedo *= tex2D(detailTex, i.uv.zw()).xyz() * unity_ColorSpaceDouble;
        float3 specularTint;
        Float oneMinusReflectivity;
        albedo = DiffuseAndSpecularFromMetallic(albedo, metallic, specularTint, oneMinusReflectivity);
        return lit(albedo, specularTint, n, normalize(worldSpaceCameraPos - i.worldPos),
                   CreateLight(source, i.worldPos));
    }
};

struct Choice
{
    int width, height;
    const char* filterName;
    Filter filter;
    int anisotropy;
    Lighting lighting;
    Decode decode;
};

template <class Light>
void drawPass(const Scene& s, const Object& o, const Choice& choice, const Light& light, const RenderState& pass)
{
    FragmentProgram<Light> fragment = s.uniforms(o.worldFromObject);
    for (sampler2D* map : {&fragment.mainTex, &fragment.detailTex, &fragment.normalMap, &fragment.detailNormalMap}) {
        map->filter = choice.filter;
        map->maxAnisotropy = choice.anisotropy;
    }
    fragment.lighting = choice.lighting;
    fragment.decode = choice.decode;
    fragment.source = light;
    s.draw(*o.mesh, VertexProgram(s.uniforms(o.worldFromObject)), fragment, pass);
}

struct Lights : DetailedMarble
{
    Float sunStrength = number("sunStrength", 0.0f, {}, "");
    Float lightStrength = number("lightStrength", 0.0f, {}, "");
};

// The stage's objects under the stage's sun and lamp.
void drawScene(const PreparedStage& stage, Frame& frame, const Choice& choice)
{
    constexpr RenderState kAdditive = {.depthTest = Compare::equal, .depthWrite = false, .blend = Blend::additive};
    frame.reset();
    frame.clear(kBackground);
    stage.log->clear();
    const Scene s = stage.scene(frame, choice.width, choice.height, stage.camera());
    const Lights lights = s.uniforms();
    const DirectionalLight sun = {lights.light.color * lights.sunStrength, lights.light.dir};
    const PointLight lamp = {float3(0.25f, 0.5f, 1.0f) * lights.lightStrength, {-0.7f, 0.9f, -0.9f}, 1.6f};
    for (const Object& o : s.objects) {
        drawPass(s, o, choice, sun, {});
        if (s.reaches("the lamp", lamp, o)) drawPass(s, o, choice, lamp, kAdditive);
    }
}

// --- pictures in linear light, compared in codes ---

struct Picture
{
    int width = 0, height = 0;
    std::vector<glm::vec4> pixels;
    std::uint64_t hash = 0;

    const glm::vec4& at(int x, int y) const
    {
        return pixels[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(std::clamp(x, 0, width - 1))];
    }
};

Picture drawn(const PreparedStage& stage, const Choice& choice)
{
    Framebuffer target = *Framebuffer::create(choice.width, choice.height, Format::rgba32f);
    Frame frame(target);
    drawScene(stage, frame, choice);
    frame.run();
    return {choice.width, choice.height, {target.color32f().begin(), target.color32f().end()}, hashOf(target)};
}

// Larger ones are averaged, smaller ones interpolated: as a screen of that size shows them.
Picture resized(const Picture& from, int width, int height)
{
    Picture to{width, height, {}};
    const int n = std::max(1, from.width / width);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            glm::vec4 sum(0.0f);
            if (from.width >= width) {
                for (int k = 0; k < n * n; ++k)
                    sum += from.at(x * n + k % n, y * n + k / n) / static_cast<float>(n * n);
            } else {
                const float scale = static_cast<float>(from.width) / static_cast<float>(width);
                const float u = (static_cast<float>(x) + 0.5f) * scale - 0.5f,
                            v = (static_cast<float>(y) + 0.5f) * scale - 0.5f;
                const int left = static_cast<int>(std::floor(u)), top = static_cast<int>(std::floor(v));
                const float s = u - static_cast<float>(left), t = v - static_cast<float>(top);
                sum = (from.at(left, top) * (1.0f - s) + from.at(left + 1, top) * s) * (1.0f - t) +
                      (from.at(left, top + 1) * (1.0f - s) + from.at(left + 1, top + 1) * s) * t;
            }
            to.pixels.push_back(sum);
        }
    }
    return to;
}

double code(float linear)
{
    return 255.0 * encodedSrgb(static_cast<double>(linear));
}

Error difference(const Picture& a, const Picture& b)
{
    ErrorSum sum;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) sum.add(code(a.pixels[i][c]) - code(b.pixels[i][c]));
    }
    return sum.result();
}

// The stage, and the reference once it is asked for: 16 samples a pixel, anisotropic, exact.
struct Subject
{
    PreparedStage stage;
    int width, height;
    std::optional<Picture> reference;

    const Picture& exact()
    {
        if (!reference) {
            const Choice best = {4 * width, 4 * height, "", Filter::trilinear, 16, Lighting::exact, Decode::root};
            reference = resized(drawn(stage, best), width, height);
        }
        return *reference;
    }
};

// What frames of one size are drawn into, in turn.
struct Screen
{
    Screen(int width, int height) : target(*Framebuffer::create(width, height, Format::rgba8Srgb)) {}
    Framebuffer target;
    Frame frame{target, {.threads = 1}};
};

void add(Experiment& e, const std::shared_ptr<Subject>& subject, const std::shared_ptr<Screen>& screen,
         const Choice& choice)
{
    constexpr const char* kLighting[] = {"Unity", "exact", "Blinn-Phong"};
    constexpr const char* kDecode[] = {"root", "1 - d/2", "1"};
    e.variants.push_back(
        {std::to_string(choice.width) + "x" + std::to_string(choice.height) + " " + choice.filterName,
         std::string(kLighting[static_cast<int>(choice.lighting)]) + ", " + kDecode[static_cast<int>(choice.decode)],
         [=] {
             const Picture picture = drawn(subject->stage, choice);
             const double all = static_cast<double>(choice.width) * choice.height;
             Outcome outcome(difference(resized(picture, subject->width, subject->height), subject->exact()),
                             {{"pixels", all}});
             outcome.imageHash = picture.hash;
             return outcome;
         },
         {[=] {
              drawScene(subject->stage, screen->frame, choice);
              screen->frame.run();
          },
          1e6}});  // nanoseconds per frame / 1e6: milliseconds
}

}  // namespace

Experiment litScene(Effort effort)
{
    Experiment e;
    e.id = "E-33";
    e.title = "The lit scene as a whole";
    e.question =
        "A budget can be spent on pixels, on the texture filter, on the lighting model or on the normals. Stage 1.25 "
        "in every combination, as a screen of 960x540 shows it: larger pictures averaged, smaller ones interpolated. "
        "The reference has 16 samples a pixel, 16 times anisotropic, with the exact lighting model. Times are "
        "milliseconds per frame, on one thread.";
    e.item = "millionth of a frame (= ms per frame)";
    e.unit = "codes of 255";
    const int width = effort.samples(960, 96), height = effort.samples(540, 54);
    Expected<PreparedStage> stage = PreparedStage::prepare(**findStage("1.25"));
    const auto subject = std::make_shared<Subject>(Subject{std::move(*stage), width, height, {}});
    struct NamedFilter
    {
        const char* name;
        Filter filter;
        int anisotropy;
    };
    const std::vector<int> halves = effort.full ? std::vector<int>{1, 2, 4} : std::vector<int>{2};
    for (const int half : halves) {
        const auto screen = std::make_shared<Screen>(width * half / 2, height * half / 2);
        for (const NamedFilter& f : {NamedFilter{"nearest", Filter::nearest, 1},
                                     {"bilinear", Filter::bilinear, 1},
                                     {"trilinear", Filter::trilinear, 1},
                                     {"anisotropic", Filter::trilinear, 16}}) {
            for (const Lighting lighting : {Lighting::exact, Lighting::unity, Lighting::blinnPhong}) {
                for (const Decode decode : {Decode::root, Decode::oneMinusHalf, Decode::one})
                    add(e, subject, screen,
                        {width * half / 2, height * half / 2, f.name, f.filter, f.anisotropy, lighting, decode});
            }
        }
    }
    e.checks.push_back({"the reference against itself", 0.0,
                        [subject] { return difference(subject->exact(), subject->exact()).max; }, 0.0});
    e.finding = [](const Rows& rows) {
        // What each choice changes, beside trilinear, exact lighting and the root at the screen's resolution.
        const auto find = [&](const std::string& name, const std::string& parameter) -> const Row& {
            for (const Row& row : rows.all) {
                if (row.name.ends_with(name) && row.parameter == parameter) return row;
            }
            return rows.all.front();
        };
        const auto described = [&](const Row& row) {
            return number(row.outcome.error.rms, 2) + " codes RMS in " + number(row.fastest, 1) + " ms";
        };
        const std::string screen = rows.all.size() > 40 ? "960x540 " : "";
        return "At the screen's resolution, trilinear with exact lighting and the root: " +
               described(find(screen + "trilinear", "exact, root")) + ". With twice the resolution: " +
               described(find((screen.empty() ? "" : "1920x1080 ") + std::string("trilinear"), "exact, root")) +
               "; with half: " +
               described(find((screen.empty() ? "" : "480x270 ") + std::string("trilinear"), "exact, root")) +
               "; with 16 times anisotropic filtering: " + described(find(screen + "anisotropic", "exact, root")) +
               "; nearest: " + described(find(screen + "nearest", "exact, root")) +
               "; with Unity's lighting: " + described(find(screen + "trilinear", "Unity, root")) +
               "; with z = 1: " + described(find(screen + "trilinear", "exact, 1")) + ".";
    };
    return e;
}

}  // namespace relief::experiments
