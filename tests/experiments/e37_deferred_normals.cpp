// E-37: encodings of normals in a deferred frame.
#include "common/render.h"
#include "common/screen_quad.h"
#include "exact_srgb.h"
#include "experiments.h"
#include "relief/pipeline/target_texture.h"
#include "relief/shading/normal_encoding.h"
#include "small_frame.h"

namespace relief::experiments {

namespace {

using namespace samples;

constexpr float kSmoothness = 0.8f;
// The sphere beside the middle of the view: at its outer edge normals lean away from the camera's axis.
const Camera kCloser = {.position = {0.0f, 0.25f, -1.6f}, .target = {0.45f, 0.0f, 0.0f}, .fieldOfView = 60.0f};

// --- encodings: a normal as four numbers that a target stores, and back ---

// From the world's space to the viewer's, where z points away from the viewer.
using Rotation = float3x3;

// Every channel in 8 bits where the target is of bytes.
struct Floats
{
    static constexpr Format kFormat = Format::rgba32f;
    static float4 encode(const float3& n, const Rotation&) { return float4(n, 1); }
    static float3 decode(const float4& code, const Rotation&) { return code.xyz(); }
};

struct Halves : Floats
{
    static constexpr Format kFormat = Format::rgba16f;
    static float3 decode(const float4& code, const Rotation&) { return normalize(code.xyz()); }
};

struct Bytes
{
    static constexpr Format kFormat = Format::rgba8;
};

struct Xyz8 : Bytes
{
    static float4 encode(const float3& n, const Rotation&) { return float4(n * 0.5f + 0.5f, 1); }
    static float3 decode(const float4& code, const Rotation&) { return normalize(code.xyz() * 2.0f - 1.0f); }
};

// Three numbers of 10 bits in four bytes, as a format of that name has them.
struct Xyz10 : Bytes
{
    static float4 encode(const float3& n, const Rotation&)
    {
        const float3 code = floor(saturate(n * 0.5f + 0.5f) * 1023.0f + 0.5f);
        const float3 high = {floor(code.x / 4.0f), floor(code.y / 16.0f), floor(code.z / 64.0f)};
        return float4(high.x, (code.x - high.x * 4.0f) * 64.0f + high.y, (code.y - high.y * 16.0f) * 16.0f + high.z,
                      (code.z - high.z * 64.0f) * 4.0f) /
               255.0f;
    }
    static float3 decode(const float4& code, const Rotation&)
    {
        const float4 bytes = floor(code * 255.0f + 0.5f);
        const float3 high = {bytes.x, floor(bytes.y / 64.0f), floor(bytes.z / 16.0f)};
        const float3 low = {high.y, high.z, floor(bytes.w / 4.0f)};
        const float3 whole = {high.x * 4.0f + low.x, (bytes.y - high.y * 64.0f) * 16.0f + low.y,
                              (bytes.z - high.z * 16.0f) * 64.0f + low.z};
        return normalize(whole / 1023.0f * 2.0f - 1.0f);
    }
};

// Two numbers of 0..1 in so many bits each.
template <int BITS>
float4 packed(const float2& v)
{
    if constexpr (BITS == 8) return float4(v, 0, 1);
    if constexpr (BITS == 12) return float4(packedTwelve(v), 1);
    return packedSixteen(v);
}
template <int BITS>
float2 unpacked(const float4& code)
{
    if constexpr (BITS == 8) return code.xy();
    if constexpr (BITS == 12) return unpackedTwelve(code.xyz());
    return unpackedSixteen(code);
}

template <int BITS>
struct Octahedral : Bytes
{
    static float4 encode(const float3& n, const Rotation&) { return packed<BITS>(octahedralOf(n)); }
    static float3 decode(const float4& code, const Rotation&) { return fromOctahedral(unpacked<BITS>(code)); }
};

// x and y in the viewer's space; z from their length, towards the viewer.
template <int BITS>
struct ViewXy : Bytes
{
    static float4 encode(const float3& n, const Rotation& viewFromWorld)
    {
        return packed<BITS>(mul(viewFromWorld, n).xy() * 0.5f + 0.5f);
    }
    static float3 decode(const float4& code, const Rotation& viewFromWorld)
    {
        const float2 v = unpacked<BITS>(code) * 2.0f - 1.0f;
        return normalize(mul(float3(v, -sqrt(saturate(1.0f - dot(v, v)))), viewFromWorld));
    }
};

// Azimuthal, of equal area: the whole sphere in a disk, the direction to the viewer in its middle.
template <int BITS>
struct Disk : Bytes
{
    static float4 encode(const float3& n, const Rotation& viewFromWorld)
    {
        const float3 v = mul(viewFromWorld, n);
        return packed<BITS>(v.xy() / sqrt(max(8.0f - 8.0f * v.z, Float(1e-30f))) + 0.5f);
    }
    static float3 decode(const float4& code, const Rotation& viewFromWorld)
    {
        const float2 v = unpacked<BITS>(code) * 4.0f - 2.0f;
        const Float square = dot(v, v);
        return normalize(mul(float3(v * sqrt(saturate(1.0f - square * 0.25f)), square * 0.5f - 1.0f), viewFromWorld));
    }
};

// --- the two passes ---

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
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float4> tangent;
};

// As in stage 5.20.
struct VertexProgram : Uniforms
{
    Interpolators operator()(VertexData v) const
    {
        return {UnityObjectToClipPos(object, v.position), v.uv, UnityObjectToWorldNormal(object, v.normal),
                float4(UnityObjectToWorldDir(object, v.tangent.xyz()), v.tangent.w)};
    }
};

struct GBuffer
{
    SV_Target<0> albedo;
    SV_Target<1> normal;
};

template <class Encoding>
struct WriteGBuffer : DetailedMarble
{
    Rotation viewFromWorld = {};

    GBuffer operator()(Interpolators i) const
    {
        const float3 binormal =
            CreateBinormal(i.normal, i.tangent.xyz(), i.tangent.w, object.unity_WorldTransformParams.w);
        const float3 bump = UnpackScaleNormal(tex2D(normalMap, i.uv), bumpScale);
        const float3 normal = TangentSpaceToWorld(bump, i.tangent.xyz(), binormal, i.normal);
        return {tex2D(mainTex, i.uv), Encoding::encode(normal, viewFromWorld)};
    }
};

enum class Show
{
    lit,
    matte,
    normal
};

// 5.20's light, and a highlight.
template <class Encoding, Show SHOW>
struct LightPixels : DetailedMarble
{
    sampler2D depth = {}, albedo = {}, normals = {};
    Rotation viewFromWorld = {};
    float4x4 worldFromClip = {};

    float4 operator()(ScreenInterpolators i, Discard& discard) const
    {
        const Float z = tex2D(depth, i.uv).x;
        discard(z == 1.0f);
        const float3 normal = Encoding::decode(tex2D(normals, i.uv), viewFromWorld), color = tex2D(albedo, i.uv).rgb();
        if constexpr (SHOW == Show::normal) return float4(normal, 1);
        if constexpr (SHOW == Show::matte)
            return float4(color * (light.color * saturate(dot(normal, light.dir)) + 0.05f), 1);
        const float4 p = mul(worldFromClip, float4(i.uv * 2.0f - 1.0f, z, 1.0f));
        const float3 viewDir = normalize(worldSpaceCameraPos - p.xyz() / p.w);
        float3 specular;
        Float oneMinusReflectivity;
        const float3 diffuse = DiffuseAndSpecularFromMetallic(color, 0.0f, specular, oneMinusReflectivity);
        return float4(
            UNITY_BRDF_PBS_Exact(diffuse, specular, kSmoothness, normal, viewDir, light).rgb() + diffuse * 0.05f, 1);
    }
};

// Draws both; what it draws with stays, so that it can be timed.
template <class Encoding>
class DeferredFrame
{
public:
    DeferredFrame(const PreparedStage& drawn, int pixels)
        : stage(drawn),
          side(pixels),
          seen(*Framebuffer::create(pixels, pixels, {{Format::rgba8Srgb}, {Encoding::kFormat}, {Format::depth32f}})),
          picture(*Framebuffer::create(pixels, pixels, {{Format::rgba32f}})),
          first(seen, {.threads = 1}),
          second(picture, {.threads = 1}),
          clipFromWorld(clipFromView(kCloser, 1.0f) * viewFromWorld(kCloser))
    {
        first.clear(glm::vec4(0.0f));
        const Scene s = stage.scene(first, side, side, kCloser);
        WriteGBuffer<Encoding> write = s.uniforms(s.objects[0].worldFromObject);
        write.viewFromWorld = rotation();
        s.draw(*s.objects[0].mesh, VertexProgram(s.uniforms(s.objects[0].worldFromObject)), write);
    }

    template <Show SHOW>
    std::span<const glm::vec4> run()
    {
        first.run();
        textures.clear();
        const auto sampler = [&](int attachment) {
            textures.push_back(*textureOf(seen, attachment));
            return sampler2D{.texture = &textures.back(), .filter = Filter::nearest, .mipmaps = false};
        };
        textures.reserve(3);
        second.reset();
        second.clear(glm::vec4(0.0f));
        LightPixels<Encoding, SHOW> light = stage.scene(second, side, side, kCloser).uniforms();
        light.depth = sampler(seen.depthIndex());
        light.albedo = sampler(seen.colorIndex(0));
        light.normals = sampler(seen.colorIndex(1));
        light.viewFromWorld = rotation();
        light.worldFromClip = broadcast(glm::inverse(clipFromWorld));
        second.draw(primitive("quad"), ScreenVertexProgram{}, light);
        second.run();
        return picture.color32f();
    }

private:
    static Rotation rotation() { return broadcast(glm::mat3(viewFromWorld(kCloser))); }

    const PreparedStage& stage;
    int side;
    Framebuffer seen, picture;
    Frame first, second;
    glm::mat4 clipFromWorld;
    std::vector<Texture> textures;
};

// --- pictures with float normals, and errors ---

struct Subject
{
    PreparedStage stage = *PreparedStage::prepare(**findStage("5.20"));
    int side;
    std::vector<glm::vec4> lit, matte, normals;

    explicit Subject(int pixels) : side(pixels) {}

    void prepare()
    {
        if (!lit.empty()) return;
        DeferredFrame<Floats> frame(stage, side);
        const auto copy = [](std::span<const glm::vec4> pixels) { return std::vector(pixels.begin(), pixels.end()); };
        lit = copy(frame.run<Show::lit>());
        matte = copy(frame.run<Show::matte>());
        normals = copy(frame.run<Show::normal>());
    }
};

double code(float linear)
{
    return 255.0 * encodedSrgb(static_cast<double>(linear));
}

// Over the pixels that were drawn, in codes.
Error difference(std::span<const glm::vec4> picture, const std::vector<glm::vec4>& exact)
{
    ErrorSum sum;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        for (int c = 0; c < 3 && exact[i].w > 0.0f; ++c) sum.add(code(picture[i][c]) - code(exact[i][c]));
    }
    return sum.result();
}

template <class Encoding>
Outcome outcomeOf(Subject& subject, double bytes)
{
    subject.prepare();
    DeferredFrame<Encoding> frame(subject.stage, subject.side);
    const std::span<const glm::vec4> pixels = frame.template run<Show::lit>();
    const Error error = difference(pixels, subject.lit);
    double off = 0.0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        bool same = true;
        for (int c = 0; c < 3; ++c) same = same && std::abs(code(pixels[i][c]) - code(subject.lit[i][c])) < 1.0;
        off += same ? 0.0 : 1.0;
    }
    const double covered = static_cast<double>(error.count) / 3.0;
    const Error matte = difference(frame.template run<Show::matte>(), subject.matte);
    ErrorSum angles;
    const std::span<const glm::vec4> normals = frame.template run<Show::normal>();
    for (std::size_t i = 0; i < normals.size(); ++i) {
        if (subject.normals[i].w > 0.0f)
            angles.add(degreesBetween(glm::dvec3(normals[i]), glm::dvec3(subject.normals[i])));
    }
    return {error,
            {{"pixels a code off, %", 100.0 * off / covered},
             {"matte alone, largest", matte.max},
             {"matte alone, RMS", matte.rms},
             {"largest angle, degrees", angles.result().max},
             {"angle, RMS", angles.result().rms},
             {"bytes of a normal", bytes}}};
}

template <class Encoding>
void add(Experiment& e, const std::shared_ptr<Subject>& subject, const char* name, const char* parameter, double bytes)
{
    const auto frame = std::make_shared<DeferredFrame<Encoding>>(subject->stage, subject->side);
    e.variants.push_back({name,
                          parameter,
                          [=] { return outcomeOf<Encoding>(*subject, bytes); },
                          {[subject, frame] { (void)frame->template run<Show::lit>(); },
                           static_cast<double>(subject->side) * subject->side}});
}

// --- the encodings alone, over directions spread evenly ---

// Of directions within so many degrees of the one to the viewer, stored in bytes.
template <class Encoding>
Error errorOf(int count, double degrees)
{
    const Rotation same = broadcast(glm::mat3(1.0f));
    std::mt19937 random(37);
    ErrorSum sum;
    const double lowest = -1.0, highest = -std::cos(degrees * kRadians);
    for (int i = 0; i < count; ++i) {
        const double z = lowest + (highest - lowest) * (i + 0.5) / count,
                     turn = 2.0 * std::numbers::pi * uniform(random), across = std::sqrt(std::max(0.0, 1.0 - z * z));
        const glm::dvec3 n(across * std::cos(turn), across * std::sin(turn), z);
        const float4 code = Encoding::encode(float3(broadcast(glm::vec3(n))), same);
        const float3 decoded = Encoding::decode(floor(saturate(code) * 255.0f + 0.5f) / 255.0f, same);
        sum.add(degreesBetween(glm::dvec3(firstLane(decoded)), n));
    }
    return sum.result();
}

// By a script without the engine.
struct Reference
{
    const char* what;
    double rms;
    std::function<Error(int count)> measured;
};
const Reference kReferences[] = {
    {"xyz in 3 x 8 bits, all directions", 0.18382, [](int n) { return errorOf<Xyz8>(n, 180.0); }},
    {"xyz in 3 x 10 bits, all directions", 0.045684, [](int n) { return errorOf<Xyz10>(n, 180.0); }},
    {"octahedral in 2 x 8 bits, all directions", 0.36991, [](int n) { return errorOf<Octahedral<8>>(n, 180.0); }},
    {"octahedral in 2 x 12 bits, all directions", 0.023013, [](int n) { return errorOf<Octahedral<12>>(n, 180.0); }},
    {"octahedral in 2 x 16 bits, all directions", 0.0014379, [](int n) { return errorOf<Octahedral<16>>(n, 180.0); }},
    {"xy in 2 x 8 bits, within 75 degrees of the viewer", 0.28631, [](int n) { return errorOf<ViewXy<8>>(n, 75.0); }},
    {"xy in 2 x 12 bits, within 75 degrees of the viewer", 0.017819,
     [](int n) { return errorOf<ViewXy<12>>(n, 75.0); }},
    {"a disk in 2 x 8 bits, within 100 degrees of the viewer", 0.3854,
     [](int n) { return errorOf<Disk<8>>(n, 100.0); }},
    {"a disk in 2 x 12 bits, within 100 degrees of the viewer", 0.024041,
     [](int n) { return errorOf<Disk<12>>(n, 100.0); }},
};

}  // namespace

Experiment deferredNormals(Effort effort)
{
    Experiment e;
    e.id = "E-37";
    e.title = "Normals in a deferred frame";
    e.question =
        "A deferred renderer writes the normal of each pixel into a target and lights it afterwards. How far is the "
        "picture from the one that has normals in floats? Stage 5.20's sphere with its bumps, by 5.20's light and "
        "GGX's highlight at smoothness 0.8; by the matte light alone; and the angles themselves. Octahedral is 5.20's "
        "square. xy are the first two numbers in the viewer's space, and z is found from their length, towards the "
        "viewer; a disk holds all directions by azimuth and equal area, the one to the viewer in its middle. Bytes are "
        "those that hold something: every target of bytes here has four. Times are of the frame: both passes, and what "
        "is between them.";
    e.item = "pixel";
    e.unit = "codes of 255";
    const auto subject = std::make_shared<Subject>(effort.samples(256, 64));
    add<Floats>(e, subject, "floats", "", 12);
    add<Halves>(e, subject, "halves", "", 6);
    add<Xyz8>(e, subject, "xyz", "3 x 8", 3);
    add<Xyz10>(e, subject, "xyz", "3 x 10", 4);
    add<Octahedral<8>>(e, subject, "octahedral", "2 x 8", 2);
    add<Octahedral<12>>(e, subject, "octahedral", "2 x 12", 3);
    add<Octahedral<16>>(e, subject, "octahedral", "2 x 16", 4);
    add<ViewXy<8>>(e, subject, "xy", "2 x 8", 2);
    add<ViewXy<12>>(e, subject, "xy", "2 x 12", 3);
    add<ViewXy<16>>(e, subject, "xy", "2 x 16", 4);
    add<Disk<8>>(e, subject, "disk", "2 x 8", 2);
    add<Disk<12>>(e, subject, "disk", "2 x 12", 3);
    add<Disk<16>>(e, subject, "disk", "2 x 16", 4);
    const int count = effort.samples(300000, 20000);
    for (const Reference& r : kReferences) {
        e.checks.push_back(
            {std::string(r.what) + ": RMS degrees", r.rms, [=] { return r.measured(count).rms; }, 0.02 * r.rms});
    }
    e.finding = [](const Rows& rows) {
        const Row &xyz = rows("xyz", "3 x 8"), &two = rows("octahedral", "2 x 8"),
                  &three = rows("octahedral", "2 x 12"), &four = rows("octahedral", "2 x 16"),
                  &view = rows("xy", "2 x 12"), &halves = rows("halves"), &ten = rows("xyz", "3 x 10");
        const auto rms = [](const Row& row, int digits = 2) { return number(row.outcome.error.rms, digits); };
        const auto fact = [](const Row& row, const char* name, int digits) { return number(row.fact(name), digits); };
        const auto off = [&](const Row& row) { return fact(row, "pixels a code off, %", 2); };
        const auto byTime = [](const Row& a, const Row& b) { return a.fastest < b.fastest; };
        const auto [fastest, slowest] = std::minmax_element(rows.all.begin(), rows.all.end(), byTime);
        return "Three bytes of xyz leave the picture " + rms(xyz) + " codes off, at most " +
               number(xyz.outcome.error.max, 1) + "; by the matte light alone at most " +
               fact(xyz, "matte alone, largest", 1) +
               ": a highlight shows what matte light forgives. As a square the same three bytes leave " +
               rms(three, 3) + ", and two " + rms(two) + ". " + off(xyz) +
               " % of the pixels are a code off with xyz, " + off(two) + " with the square in two bytes, " +
               off(three) + " in three. In four bytes the square is " + rms(four, 4) + " off, 10 bits of each of xyz " +
               rms(ten, 3) + ", and halves, in six, " + rms(halves, 3) + ". x and y in the viewer's space are " +
               rms(view, 3) +
               " off with the square's three bytes, but they lose the sign of z: at the sphere's outer edge, where "
               "normals lean away from the camera's axis, they are up to " +
               fact(view, "largest angle, degrees", 1) + " degrees off, the square " +
               fact(three, "largest angle, degrees", 2) + ". An encoding costs little beside its frame: the slowest, " +
               slowest->name + ", takes " + number(slowest->fastest / fastest->fastest, 2) +
               " times the fastest's time, the square in three bytes " + number(three.fastest / xyz.fastest, 2) +
               " times that of xyz.";
    };
    return e;
}

}  // namespace relief::experiments
