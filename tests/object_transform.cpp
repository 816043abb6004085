// Objects' matrices: normals under any scale, mirrored objects, places far from the origin, and normals without a
// direction (stability cases S-107 to S-111, S-409).
#include "relief/shading/object_transform.h"

#include "numbers.h"
#include "pipeline_fixture.h"
#include "relief/mesh/primitives.h"
#include "shading_fixture.h"

using namespace fixture;

namespace {

const glm::mat4 kIdentity(1.0f);

glm::mat4 scale(float x, float y, float z)
{
    return {{x, 0, 0, 0}, {0, y, 0, 0}, {0, 0, z, 0}, {0, 0, 0, 1}};
}

Vector worldNormal(const glm::mat4& worldFromObject, const glm::vec3& normal)
{
    const ObjectTransform object(kIdentity, worldFromObject);
    return lane(UnityObjectToWorldNormal(object, {normal.x, normal.y, normal.z}));
}

const glm::vec3 kNormals[] = {{0, 0, 1},    {0.6f, 0, 0.8f}, {-0.6f, 0, -0.8f},     {0, 0.8f, -0.6f},
                              {1, 0, 0},    {0, -1, 0},      {0.48f, 0.64f, -0.6f}, {0.001f, 0.0f, 0.9999995f},
                              {0, 1, 1e-6f}};

// A camera at z = -3 that looks along +z.
const glm::mat4 kClipFromWorld = {{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 1.1f, 1}, {0, 0, 2.2f, 3}};

struct VertexData
{
    POSITION position;
    NORMAL normal;
};

struct Interpolators
{
    SV_POSITION position;
    TEXCOORD<0, float3> normal;
};

struct Vertex
{
    ObjectTransform object;

    Interpolators operator()(VertexData v) const
    {
        return {UnityObjectToClipPos(object, v.position), UnityObjectToWorldNormal(object, v.normal)};
    }
};

struct Normal
{
    float4 operator()(Interpolators i) const { return float4(normalize(i.normal), 1); }
};

Framebuffer normalsOf(const Mesh& mesh, const glm::mat4& worldFromObject)
{
    Framebuffer target = makeTarget(80, 60);
    Frame frame(target, {1, kDefaultTileSize});
    frame.clear(glm::vec4(0.0f));
    frame.setFrontCounterClockwise(mirrorSign(worldFromObject) < 0.0f);
    frame.draw(mesh, Vertex{ObjectTransform(kClipFromWorld, worldFromObject)}, Normal());
    checkInvariants(target, frame.run());
    return target;
}

Vector vectorOf(const glm::vec4& c)
{
    return {static_cast<double>(c.x), static_cast<double>(c.y), static_cast<double>(c.z)};
}

}  // namespace

TEST_CASE("object transform: S-107 singular matrices give normals without a NaN, and flattened ones the right ones")
{
    double worst = 0.0;
    for (const glm::vec3& n : kNormals) {
        const Vector flat = worldNormal(scale(1, 1, 0), n);
        if (n.z == 0.0f) {
            CHECK(length(flat) == 0.0);
        } else {
            worst = std::fmax(worst, angle(flat, {0, 0, n.z > 0.0f ? 1.0 : -1.0}));
        }
        CHECK(length(worldNormal(scale(0, 0, 0), n)) == 0.0);
        CHECK(length(worldNormal(scale(1, 0, 0), n)) == 0.0);
    }
    measured("degrees off +-z", worst, 1e-4);
    for (const glm::mat4& singular : {scale(1, 1, 0), scale(0, 0, 0), scale(0, 2, 0), scale(0, 1, 1)}) {
        normalsOf(makeCube(), singular);  // finite
    }
}

TEST_CASE("object transform: S-108 an object that its matrix mirrors looks like a mesh that is mirrored")
{
    for (const glm::vec3 sign : {glm::vec3(-1, 1, 1), glm::vec3(1, -1, 1), glm::vec3(-1, -1, -1)}) {
        const Mesh sphere = makeSphere(24, 12);
        Mesh mirrored = sphere;
        for (std::size_t i = 0; i < mirrored.positions.size(); ++i) {
            mirrored.positions[i] *= sign;
            mirrored.normals[i] *= sign;
        }
        for (std::size_t i = 0; i < mirrored.indices.size(); i += 3) {
            std::swap(mirrored.indices[i + 1], mirrored.indices[i + 2]);
        }
        const glm::mat4 turned = {{0.8f, 0, -0.6f, 0}, {0, 1, 0, 0}, {0.6f, 0, 0.8f, 0}, {0, 0, 0, 1}};
        const Framebuffer byMatrix = normalsOf(sphere, turned * scale(sign.x, sign.y, sign.z));
        const Framebuffer byMesh = normalsOf(mirrored, turned);
        int other = 0, drawn = 0;
        double worst = 0.0;
        for (std::size_t i = 0; i < byMatrix.color32f().size(); ++i) {
            const glm::vec4 a = byMatrix.color32f()[i], b = byMesh.color32f()[i];
            other += a.w != b.w;
            if (a.w == 0.0f || b.w == 0.0f) continue;
            ++drawn;
            worst = std::fmax(worst, angle(vectorOf(a), vectorOf(b)));
        }
        CHECK(drawn > 300);
        measured("pixels that only one covers", other, 0);
        measured("degrees between the normals", worst, 1e-4);
    }
}

TEST_CASE("object transform: S-109 normals stay perpendicular under very unequal scales")
{
    double worst = 0.0, length1e6 = 0.0;
    for (const float large : {1e3f, 1e6f}) {
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 factors(1.0f);
            factors[axis] = large;
            const glm::mat4 turned = {{0.8f, 0, -0.6f, 0}, {0, 1, 0, 0}, {0.6f, 0, 0.8f, 0}, {0, 0, 0, 1}};
            const glm::mat4 matrix = turned * scale(factors.x, factors.y, factors.z);
            for (const glm::vec3& n : kNormals) {
                // In double: the inverse's transpose.
                const glm::dmat3 exact(matrix);
                const glm::dvec3 expected = glm::transpose(glm::inverse(exact)) * glm::dvec3(n);
                const Vector normal = worldNormal(matrix, n);
                REQUIRE(isFinite(normal));
                if (large == 1e3f) {
                    worst = std::fmax(worst, angle(normal, {expected.x, expected.y, expected.z}));
                } else {
                    length1e6 = std::fmax(length1e6, std::fabs(length(normal) - 1.0));
                }
            }
        }
    }
    measured("degrees off at 1000:1", worst, 0.0137);
    measured("length off 1 at 1e6:1", length1e6, 4 * 0x1p-23);
}

TEST_CASE("object transform: S-110 with the camera subtracted in double, a million units away is like here")
{
    // The camera stands 3 units before the object. Pixels of 1920 a width: NDC times 960.
    for (const double far : {1e6, 1e7}) {
        const glm::dvec3 camera(far + 0.03, -far - 0.71, far), place = camera + glm::dvec3(0.26, -0.13, 3.07);
        const auto move = [](const glm::vec3& offset) {
            return glm::mat4{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {offset.x, offset.y, offset.z, 1}};
        };
        const glm::mat4 clipFromCamera = {{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 1.001f, 1}, {0, 0, -0.1f, 0}};
        const ObjectTransform relative(clipFromCamera, move(glm::vec3(place - camera)));
        const ObjectTransform absolute(clipFromCamera * move(glm::vec3(-camera)), move(glm::vec3(place)));
        double withOption = 0.0, without = 0.0;
        Random random(110);
        for (int i = 0; i < 1000; ++i) {
            const glm::vec3 p = {random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
            const glm::dvec3 seen = place - camera + glm::dvec3(p);
            const double x = 2.0 * seen.x / seen.z * 960.0, y = 2.0 * seen.y / seen.z * 960.0;
            const auto error = [&](const ObjectTransform& object) {
                const float4 clip = UnityObjectToClipPos(object, {p.x, p.y, p.z, 1.0f});
                const double w = static_cast<double>(clip.w[0]);
                return std::fmax(std::fabs(static_cast<double>(clip.x[0]) / w * 960.0 - x),
                                 std::fabs(static_cast<double>(clip.y[0]) / w * 960.0 - y));
            };
            withOption = std::fmax(withOption, error(relative));
            without = std::fmax(without, error(absolute));
        }
        measured("pixels off, the camera subtracted in double", withOption, 1.0 / 256.0);
        stability::noted(far == 1e6 ? "pixels off without, at 1e6" : "pixels off without, at 1e7", without);
        CHECK(without > 1.0);  // there is something to gain
    }
}

TEST_CASE("object transform: S-111 short vertex normals keep their direction, and those without one light nothing")
{
    double worst = 0.0;
    for (const float tiny : {1e-30f, 1e-37f, 1e30f}) {
        for (const glm::vec3& n : kNormals) {
            const Vector normal = worldNormal(kIdentity, n * tiny);
            worst = std::fmax(worst, std::fabs(length(normal) - 1.0));
            CHECK(angle(normal, {static_cast<double>(n.x), static_cast<double>(n.y), static_cast<double>(n.z)}) <= 0.1);
        }
    }
    measured("length off 1", worst, 4 * 0x1p-23);
    // And those of objects of all sizes, mirrored ones too.
    for (const float size : {1e-30f, 1e-12f, 1e12f, 1e30f}) {
        CAPTURE(size);
        for (const float x : {size, -size}) {
            const glm::mat4 matrix = scale(x, 2.0f * size, size);
            CHECK(mirrorSign(matrix) == (x < 0.0f ? -1.0f : 1.0f));
            for (const glm::vec3& n : kNormals) {
                const Vector normal = worldNormal(matrix, n), usual = worldNormal(scale(x / size, 2, 1), n);
                CHECK(angle(normal, usual) <= 1e-4);
            }
        }
    }
    for (const glm::vec3& none : {glm::vec3(0.0f), glm::vec3(kNan, 0, 1), glm::vec3(0, kNan, 0)}) {
        CHECK(length(worldNormal(kIdentity, none)) == 0.0);
    }
}

TEST_CASE("object transform: S-409 between opposite normals there is one pixel without a direction, and no NaN")
{
    // 33 pixels from z = -1 to z = 1: the middle one's normal is exactly 0.
    struct Lit
    {
        float4 operator()(const Interpolated& i) const
        {
            const float3 n = normalize(i.value.xyz());
            return float4(dot(n, float3(0, 0, 1)), dot(n, n), 0, 1);
        }
    };
    Mesh mesh;
    const TestVertex left[2] = {{{-1, -1, 0, 1}, {0, 0, -1, 0}}, {{-1, 1, 0, 1}, {0, 0, -1, 0}}};
    const TestVertex right[2] = {{{1, -1, 0, 1}, {0, 0, 1, 0}}, {{1, 1, 0, 1}, {0, 0, 1, 0}}};
    addTriangle(mesh, left[0], left[1], right[0]);
    addTriangle(mesh, right[0], left[1], right[1]);
    Framebuffer target = makeTarget(33, 9);
    const Statistics statistics = drawClip<kPaint>(target, mesh, Lit{});
    checkInvariants(target, statistics);
    measured("colours NaN or infinite", statistics.invalidColors, 0);
    int wrong = 0;
    double worst = 0.0;
    for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 33; ++x) {
            const glm::vec4 c = pixel(target, x, y);
            wrong += x != 16 && std::fabs(c.x - (x < 16 ? -1.0f : 1.0f)) > 0x1p-22f;
            // On the middle line rounding may leave a direction; it is a unit vector or nothing.
            worst = std::fmax(worst, std::fmin(std::fabs(static_cast<double>(c.y) - 1.0), static_cast<double>(c.y)));
        }
    }
    CHECK(wrong == 0);
    measured("square of the length off 0 and off 1", worst, 8 * 0x1p-23);
}
