#include "stability_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "common/camera.h"
#include "relief/mesh/primitives.h"
#include "relief/pipeline/format.h"
#include "relief/relief.h"
#include "relief/shading/cotangent_frame.h"
#include "relief/shading/normals.h"
#include "relief/shading/triplanar.h"
#include "relief/texture/image.h"
#include "report.h"

namespace relief::samples {

namespace {

constexpr int kSide = 256;  // of one of the two pictures, in pixels
constexpr int kGap = 8;

// --- drawing ---

struct VertexData
{
    POSITION position;
    NORMAL normal;
    TEXCOORD<0, float2> uv;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float2> uv;
    TEXCOORD<1, float3> worldPos;
    TEXCOORD<2, float3> normal;
};

struct VertexProgram
{
    ObjectTransform object;

    Interpolators operator()(VertexData v) const
    {
        return {UnityObjectToClipPos(object, v.position), v.uv, mul(object.worldFromObject, v.position).xyz(),
                UnityObjectToWorldNormal(object, v.normal)};
    }
};

// NaN would become black, as a target holds none: here it is to be seen.
float4 withNanInMagenta(const float3& color)
{
    const Mask nan = isnan(color.x) | isnan(color.y) | isnan(color.z);
    return float4(select(nan, float3(1, 0, 1), color), 1);
}

using Panel = std::vector<std::uint32_t>;  // kSide x kSide, RGBA

Panel panelOf(const Framebuffer& target)
{
    return {target.color8().begin(), target.color8().end()};
}

// One mesh, seen by a camera at `from` that looks at the origin.
template <RenderState state = RenderState{.cull = Cull::none}, class Vertex = VertexProgram, class Fragment>
Panel drawn(const Mesh& mesh, const Fragment& fragment, const glm::vec3& from, float fieldOfView = 40.0f,
            const glm::vec3& at = glm::vec3(0.0f))
{
    const Camera camera = {.position = from, .target = at, .fieldOfView = fieldOfView};
    Framebuffer target = *Framebuffer::create(kSide, kSide, Format::rgba8Srgb);
    Frame frame(target);
    frame.clear({0.02f, 0.025f, 0.03f, 1.0f});
    frame.draw(mesh, Vertex{ObjectTransform(clipFromView(camera, 1.0f) * viewFromWorld(camera), glm::mat4(1.0f))},
               fragment, state);
    frame.run();
    return panelOf(target);
}

// Pixels of a small picture as squares.
template <class Color>
Panel enlarged(int side, const Color& color)
{
    Panel panel(kSide * kSide);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            panel[static_cast<std::size_t>(y * kSide + x)] = color(x * side / kSide, y * side / kSide);
        }
    }
    return panel;
}

constexpr std::uint32_t rgb(std::uint32_t r, std::uint32_t g, std::uint32_t b)
{
    return r | g << 8 | b << 16 | 0xff000000u;
}

Mesh floorPlane(float extent, float repeats)
{
    Mesh mesh;
    mesh.positions = {{-extent, 0, -extent}, {-extent, 0, extent}, {extent, 0, extent}, {extent, 0, -extent}};
    mesh.normals.assign(4, {0, 1, 0});
    mesh.uvs = {{0, 0}, {0, repeats}, {repeats, repeats}, {repeats, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

// --- S-302: holes ---

// The grid's corners in pixels from (8000, 4000) on: many are pixel centres, where several triangles meet.
constexpr int kCells = 12, kMeshSide = 64;
constexpr float kMeshX = 8000.0f, kMeshY = 4000.0f;

using Corner = glm::vec2;
std::vector<std::array<Corner, 3>> triangulation()
{
    std::uint32_t state = 302;
    const auto jitter = [&](bool moves) {
        state = state * 1664525u + 1013904223u;
        return moves ? static_cast<float>(state >> 24) / 128.0f - 1.0f : 0.0f;
    };
    std::vector<Corner> points;
    for (int y = 0; y <= kCells; ++y) {
        for (int x = 0; x <= kCells; ++x) {
            Corner p = Corner(kMeshX, kMeshY) + Corner(x, y) * (kMeshSide / static_cast<float>(kCells));
            p += Corner(jitter(x > 0 && x < kCells), jitter(y > 0 && y < kCells));
            if ((x + y) % 2 == 0 && x > 0 && y > 0 && x < kCells && y < kCells) p = floor(p) + 0.5f;
            points.push_back(p);
        }
    }
    std::vector<std::array<Corner, 3>> triangles;
    for (int y = 0; y < kCells; ++y) {
        for (int x = 0; x < kCells; ++x) {
            const auto at = [&](int dx, int dy) {
                return points[static_cast<std::size_t>((y + dy) * (kCells + 1) + x + dx)];
            };
            triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
            triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
        }
    }
    return triangles;
}

std::uint32_t countColor(int count)
{
    return count == 0 ? rgb(255, 0, 255) : count == 1 ? rgb(120, 130, 140) : rgb(255, 220, 0);
}

Panel holesNaive()
{
    std::vector<int> counts(kMeshSide * kMeshSide);
    const auto edge = [](const Corner& a, const Corner& b, const Corner& p) {
        return a.x * (b.y - p.y) + b.x * (p.y - a.y) + p.x * (a.y - b.y);  // twice the area, in floats
    };
    for (const auto& [a, b, c] : triangulation()) {
        for (int i = 0; i < kMeshSide * kMeshSide; ++i) {
            const Corner p = Corner(kMeshX, kMeshY) + Corner(i % kMeshSide, i / kMeshSide) + 0.5f;
            counts[static_cast<std::size_t>(i)] += edge(a, b, p) > 0.0f && edge(b, c, p) > 0.0f && edge(c, a, p) > 0.0f;
        }
    }
    return enlarged(kMeshSide,
                    [&](int x, int y) { return countColor(counts[static_cast<std::size_t>(y * kMeshSide + x)]); });
}

// Positions are in pixels, from the corner of a picture of 16384 x 8192.
constexpr glm::vec2 kLargeTarget = {16384.0f, 8192.0f};

struct InPixels
{
    Interpolators operator()(VertexData v) const
    {
        const Float w = v.normal.x;
        Interpolators i;
        i.position = float4((v.position.x / (kLargeTarget.x * 0.5f) - 1.0f) * w,
                            (1.0f - v.position.y / (kLargeTarget.y * 0.5f)) * w, 0.5f * w, w);
        i.uv = v.uv;
        i.worldPos = v.position.xyz();
        i.normal = v.normal;
        return i;
    }
};

struct One
{
    float4 operator()(const Interpolators&) const { return float4(Float(1.0f)); }
};

void addInPixels(Mesh& mesh, const Corner& p, float w, float u)
{
    mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back({p.x, p.y, 0.5f});
    mesh.normals.push_back({w, 0, 0});
    mesh.uvs.push_back({u, 0});
}

template <class Fragment>
Framebuffer drawnInPixels(const Mesh& mesh, const Fragment& fragment, int x, int y, int side)
{
    constexpr RenderState kCount = {Compare::always, false, true, Cull::none, Blend::additive};
    Framebuffer target = *Framebuffer::create(side, side, Format::rgba32f);
    Frame frame(target);
    frame.clear(glm::vec4(0.0f));
    frame.setViewport({-x, -y, static_cast<int>(kLargeTarget.x), static_cast<int>(kLargeTarget.y)});
    frame.draw(mesh, InPixels(), fragment, kCount);
    frame.run();
    return target;
}

Panel holesOurs()
{
    Mesh mesh;
    for (const auto& triangle : triangulation()) {
        for (const Corner& p : triangle) addInPixels(mesh, p, 1.0f, 0.0f);
    }
    const Framebuffer target =
        drawnInPixels(mesh, One(), static_cast<int>(kMeshX), static_cast<int>(kMeshY), kMeshSide);
    return enlarged(kMeshSide, [&](int x, int y) {
        return countColor(static_cast<int>(target.color32f()[static_cast<std::size_t>(y * kMeshSide + x)].x));
    });
}

// --- S-401: interpolation far from the origin ---

constexpr int kFarX = 3800, kFarY = 2100, kFarSide = 128;

// Triangles of 2 px whose corners' w differ by a factor of 1000; u grows from corner to corner.
Mesh smallTriangles()
{
    Mesh mesh;
    const auto add = [&](int x, int y) {
        const float w = (x / 2 + y / 2) % 2 == 0 ? 1.0f : 1000.0f;
        addInPixels(mesh, {static_cast<float>(x), static_cast<float>(y)}, w,
                    static_cast<float>(x - kFarX + (y - kFarY) / 2) / static_cast<float>(kFarSide));
    };
    for (int y = kFarY; y < kFarY + kFarSide; y += 2) {
        for (int x = kFarX; x < kFarX + kFarSide; x += 2) {
            add(x, y), add(x + 2, y), add(x, y + 2);
            add(x + 2, y), add(x + 2, y + 2), add(x, y + 2);
        }
    }
    return mesh;
}

std::uint32_t stripe(float u)
{
    if (!(std::abs(u) < 1e6f)) return rgb(255, 0, 255);
    const float phase = u * 4.0f - std::floor(u * 4.0f);
    const auto grey = static_cast<std::uint32_t>(40.0f + 180.0f * (phase < 0.5f ? phase * 2.0f : 2.0f - phase * 2.0f));
    return rgb(grey, grey, grey);
}

// u / w and 1 / w as a x + b y + c with c at the picture's corner, all in floats.
Panel planesAboutTheOrigin()
{
    const Mesh mesh = smallTriangles();
    std::vector<float> us(kFarSide * kFarSide);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 &p = mesh.positions[i], &q = mesh.positions[i + 1], &r = mesh.positions[i + 2];
        const float area = (q.x - p.x) * (r.y - p.y) - (r.x - p.x) * (q.y - p.y);
        const auto plane = [&](float fp, float fq, float fr) {
            const float a = ((fq - fp) * (r.y - p.y) - (fr - fp) * (q.y - p.y)) / area;
            const float b = ((fr - fp) * (q.x - p.x) - (fq - fp) * (r.x - p.x)) / area;
            return glm::vec3(a, b, fp - a * p.x - b * p.y);
        };
        float f[3], g[3];
        for (std::size_t k = 0; k < 3; ++k) {
            g[k] = 1.0f / mesh.normals[i + k].x;
            f[k] = mesh.uvs[i + k].x * g[k];
        }
        const glm::vec3 uw = plane(f[0], f[1], f[2]), invW = plane(g[0], g[1], g[2]);
        const int x0 = static_cast<int>(std::min({p.x, q.x, r.x})), y0 = static_cast<int>(std::min({p.y, q.y, r.y}));
        const bool upper = i % 6 == 0;
        for (int dy = 0; dy < 2; ++dy) {
            for (int dx = 0; dx < 2; ++dx) {
                if (upper ? dx + dy > 0 : dx + dy == 0) continue;  // which of the two triangles has the pixel
                const float x = static_cast<float>(x0 + dx) + 0.5f, y = static_cast<float>(y0 + dy) + 0.5f;
                us[static_cast<std::size_t>((y0 + dy - kFarY) * kFarSide + x0 + dx - kFarX)] =
                    (uw.x * x + uw.y * y + uw.z) / (invW.x * x + invW.y * y + invW.z);
            }
        }
    }
    return enlarged(kFarSide, [&](int x, int y) { return stripe(us[static_cast<std::size_t>(y * kFarSide + x)]); });
}

struct U
{
    float4 operator()(const Interpolators& i) const { return float4(i.uv.x, Float(0.0f), Float(0.0f), Float(1.0f)); }
};

Panel interpolated()
{
    const Framebuffer target = drawnInPixels(smallTriangles(), U(), kFarX, kFarY, kFarSide);
    return enlarged(kFarSide, [&](int x, int y) {
        return stripe(target.color32f()[static_cast<std::size_t>(y * kFarSide + x)].x);
    });
}

// --- S-104: division by w before clipping ---

struct DividedFirst
{
    ObjectTransform object;

    Interpolators operator()(VertexData v) const
    {
        Interpolators i = VertexProgram{object}(v);
        const float4 p = i.position;
        i.position = float4(p.xyz() / p.w, Float(1.0f));
        return i;
    }
};

Texture checker(int side, ColorSpace meaning)
{
    std::vector<std::uint8_t> texels;
    for (int i = 0; i < side * side; ++i) {
        const std::uint8_t code = (i % side + i / side) % 2 == 0 ? 255 : 0;
        texels.insert(texels.end(), {code, code, code, 255});
    }
    return *Texture::fromRgba8(side, side, texels, meaning);
}

struct Textured
{
    sampler2D map;
    bool wraps = false, codes = false;

    float4 operator()(const Interpolators& i) const
    {
        const float2 uv = i.uv;
        float3 color = tex2D(map, wraps ? frac(uv) : uv).xyz();
        if (codes)
            color = {pow(color.x, Float(2.2f)), pow(color.y, Float(2.2f)),
                     pow(color.z, Float(2.2f))};  // texels that were averaged as they are stored
        return withNanInMagenta(color);
    }
};

Panel floorThroughTheEye(bool naive)
{
    const Texture tiles = checker(8, ColorSpace::linear);
    const Textured fragment = {{.texture = &tiles, .filter = Filter::nearest, .mipmaps = false}};
    const Mesh mesh = floorPlane(3.0f, 1.0f);
    const glm::vec3 from = {0.4f, 0.5f, -1.0f}, at = {0.2f, 0.3f, 1.0f};
    constexpr RenderState kUnclipped = {.depthTest = Compare::always, .depthClip = false, .cull = Cull::none};
    return naive ? drawn<kUnclipped, DividedFirst>(mesh, fragment, from, 60.0f, at)
                 : drawn(mesh, fragment, from, 60.0f, at);
}

// --- S-503: a seam ---

Panel seam(bool naive)
{
    std::vector<std::uint8_t> texels;
    for (int i = 0; i < 64 * 64; ++i) {
        const bool dark = (i % 64 / 16 + i / 64 / 16) % 2 == 0;
        texels.insert(texels.end(), {static_cast<std::uint8_t>(dark ? 30 : 210),
                                     static_cast<std::uint8_t>(dark ? 60 : 190), 120, 255});
    }
    const Texture tiles = *Texture::fromRgba8(64, 64, texels, ColorSpace::srgb);
    return drawn(floorPlane(2.0f, 3.0f), Textured{{.texture = &tiles}, naive}, {0.3f, 1.3f, -2.2f}, 50.0f,
                 {0, 0, 0.1f});
}

// --- S-563: levels of a checker ---

Panel checkerLevels(bool naive)
{
    const Texture fine = checker(64, naive ? ColorSpace::linear : ColorSpace::srgb);
    return drawn(floorPlane(4.0f, 1.0f), Textured{{.texture = &fine}, false, naive}, {0.0f, 0.9f, -3.2f}, 50.0f,
                 {0, 0, 0.5f});
}

// --- S-601: two-channel normals ---

Panel decoded(bool naive)
{
    Panel panel(kSide * kSide);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const float4 texel = {1.0f, static_cast<float>(255 - y) / 255.0f, 1.0f, static_cast<float>(x) / 255.0f};
            float3 n = UnpackScaleNormal(texel, 1.0f);
            if (naive) {
                const float2 xy = {texel.w * 2.0f - 1.0f, texel.y * 2.0f - 1.0f};
                n = float3(xy, sqrt(1.0f - dot(xy, xy)));
            }
            const float4 color = withNanInMagenta(saturate(normalize(n) * 0.5f + 0.5f) + (n - n));
            panel[static_cast<std::size_t>(y * kSide + x)] = static_cast<std::uint32_t>(packRgba8(color)[0]);
        }
    }
    return panel;
}

// --- S-655: no uv to take a frame from ---

struct Bumpy
{
    bool naive;

    float4 operator()(const Interpolators& i) const
    {
        // In every other square of the picture uv does not change.
        const float2 cell = floor(i.uv * float2(12.0f, 6.0f));
        const Mask constant = frac((cell.x + cell.y) * 0.5f) > 0.25f;
        const float2 uv = select(constant, float2(0.25f), i.uv);
        const float3 bump = normalize(float3(0.5f * sin(i.uv.x * 200.0f), 0.5f * sin(i.uv.y * 100.0f), 1.0f));
        const float3 normal = normalize(i.normal);
        float3 bent = perturb_normal(bump, normal, i.worldPos, uv);
        if (naive) {
            const float3 dp1 = ddx(i.worldPos), dp2 = ddy(i.worldPos);
            const float2 duv1 = ddx(uv), duv2 = ddy(uv);
            const float3 dp2perp = cross(dp2, normal), dp1perp = cross(normal, dp1);
            const float3 t = dp2perp * duv1.x + dp1perp * duv2.x, b = dp2perp * duv1.y + dp1perp * duv2.y;
            const Float invmax = 1.0f / sqrt(max(dot(t, t), dot(b, b)));
            const float3 sum = (t * bump.x + b * bump.y) * invmax + normal * bump.z;
            bent = sum / sqrt(dot(sum, sum));
        }
        const Float lambert = max(Float(0.0f), dot(bent, normalize(float3(0.5f, 0.7f, -0.8f))));
        return withNanInMagenta(float3(0.05f, 0.06f, 0.08f) + float3(0.9f, 0.8f, 0.7f) * (lambert + (bent.x - bent.x)));
    }
};

// --- S-702: weights in a corner ---

struct Weights
{
    bool naive;

    float4 operator()(const Interpolators& i) const
    {
        const float3 normal = normalize(i.normal);
        float3 weights = TriplanarBlendOffset(normal, 0.65f);
        if (naive) {
            weights = max(abs(normal) - 0.65f, float3(0.0f));
            weights = weights / (weights.x + weights.y + weights.z);
        }
        return withNanInMagenta(weights);
    }
};

// --- S-803: the terminator; S-807: the highlight of a smooth sphere ---

struct Terminator
{
    bool naive;

    float4 operator()(const Interpolators& i) const
    {
        const float3 normal = normalize(i.normal), light = normalize(float3(0.75f, 0.25f, 0.55f));
        const float3 view = normalize(float3(0.0f, 0.0f, -2.0f) - i.worldPos);
        const Float NdotL = dot(normal, light);
        const Float highlight = pow(saturate(dot(reflect(-light, normal), view)), Float(4.0f));
        const Float cut = naive ? select(NdotL < 0.0f, Float(0.0f), Float(1.0f)) : max(NdotL, Float(0.0f));
        return withNanInMagenta(float3(0.5f, 0.25f, 0.1f) * max(NdotL, Float(0.0f)) + highlight * cut);
    }
};

struct Highlight
{
    bool naive;

    float4 operator()(const Interpolators& i) const
    {
        const float3 normal = normalize(i.normal);
        const float3 view = normalize(float3(0.0f, 0.0f, -2.0f) - i.worldPos);
        const UnityLight light = {float3(0.005f), normalize(float3(0.4f, 0.6f, -0.9f))};
        const float3 diffuse = {24.0f, 2.0f, 1.6f}, specular = float3(0.04f);  // the highlight's peak is about 1
        const float3 color = (naive ? UNITY_BRDF_PBS(diffuse, specular, 0.92f, normal, view, light)
                                    : UNITY_BRDF_PBS_Exact(diffuse, specular, 0.92f, normal, view, light))
                                 .xyz();
        return withNanInMagenta(color);
    }
};

template <class Fragment>
Panel sphere(bool naive, const glm::vec3& from)
{
    return drawn(makeSphere(96, 48), Fragment{naive}, from, 34.0f);
}

// --- all of them ---

struct Pair
{
    const char* id;
    const char* file;
    const char* naive;
    const char* ours;
    Panel (*draw)(bool naive);
};

const Pair kPairs[] = {
    {"S-104", "division_before_clipping", "corners behind the eye divided by their w: the floor turns inside out",
     "clipped first", floorThroughTheEye},
    {"S-302", "edge_functions", "edges in floats, inside is > 0: holes (magenta) at shared corners and edges",
     "integers and the top-left rule: every pixel once", [](bool naive) { return naive ? holesNaive() : holesOurs(); }},
    {"S-401", "plane_equations",
     "u of 2 px triangles (w ratio 1000), 3800 px from the origin, by planes about the origin",
     "by weights from exact edge functions",
     [](bool naive) { return naive ? planesAboutTheOrigin() : interpolated(); }},
    {"S-503", "seam", "tex2D(frac(uv)): the difference across the seam is the smallest level", "tex2D(uv)", seam},
    {"S-563", "checker", "sRGB codes averaged: the distance is too dark", "averaged in linear light", checkerLevels},
    {"S-601", "decoding", "z = sqrt(1 - x^2 - y^2): NaN (magenta) in the corners", "z = 0 there", decoded},
    {"S-655", "cotangent_frame", "constant uv, in every other square: 1/0 times 0 (magenta)",
     "the surface's own normal",
     [](bool naive) {
         return sphere<Bumpy>(naive, {0, 0, -2});
     }},
    {"S-702", "weights", "an offset of 0.65: 0/0 (magenta) where all three components are smaller",
     "the offset ends at 0.55",
     [](bool naive) {
         return sphere<Weights>(naive, {1.2f, 1.2f, -1.2f});
     }},
    {"S-803", "terminator", "a highlight that is cut off at N.L = 0", "multiplied by N.L",
     [](bool naive) {
         return sphere<Terminator>(naive, {0, 0, -2});
     }},
    {"S-807", "highlight", "smoothness 0.92, GGX with 1e-7 in its denominator: 1/61 of the peak", "without an epsilon",
     [](bool naive) {
         return drawn(makeSphere(96, 48), Highlight{naive}, {0, 0, -2}, 8.0f, {0.09f, 0.138f, -0.47f});
     }},
};

Expected<void> writePair(const std::filesystem::path& path, const Panel& naive, const Panel& ours)
{
    constexpr int kWidth = 2 * kSide + kGap;
    std::vector<std::uint8_t> rgba;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            std::uint32_t color = rgb(255, 255, 255);
            if (x < kSide) color = naive[static_cast<std::size_t>(y * kSide + x)];
            if (x >= kSide + kGap) color = ours[static_cast<std::size_t>(y * kSide + x - kSide - kGap)];
            for (int shift = 0; shift < 32; shift += 8) rgba.push_back(static_cast<std::uint8_t>(color >> shift));
        }
    }
    return writePng(path, kWidth, kSide, rgba);
}

}  // namespace

Expected<std::string> writeStabilityPictures(const ReportOptions& options)
{
    std::string markdown;
    for (const Pair& pair : kPairs) {
        const bool wanted =
            options.only.empty() || std::find(options.only.begin(), options.only.end(), pair.id) != options.only.end();
        if (!wanted) continue;
        showProgress(std::string("picture of ") + pair.id);
        const std::string file = std::string("stability/") + pair.file + ".png";
        const std::filesystem::path path = std::filesystem::path(options.output) / file;
        std::error_code error;
        std::filesystem::create_directories(path.parent_path(), error);
        if (error) {
            return fail(path.parent_path().string() + ": cannot make the folder (" + error.message() +
                        "); choose another with --output");
        }
        const Expected<void> written = writePair(path, pair.draw(true), pair.draw(false));
        if (!written) return tl::unexpected(written.error());
        if (markdown.empty()) {
            markdown =
                "\n## Pictures\n\nLeft: the obvious form. Right: Relief. NaN and holes are magenta, pixels that are "
                "drawn twice yellow.\n";
        }
        markdown += std::string("\n**") + pair.id + "** Left: " + pair.naive + ". Right: " + pair.ours + ".\n\n![" +
                    pair.naive + "](" + file + ")\n";
    }
    showProgress("");
    return markdown;
}

}  // namespace relief::samples
