// Cotangent frames: the same as algebra says on a plane, turned upside down, and where there is no frame (stability
// cases S-503, S-655 and S-656; S-657 is in triplanar_stages.cpp).
#include "relief/shading/cotangent_frame.h"

#include <cmath>
#include <limits>

#include "common/triplanar_methods.h"
#include "relief/lanes/int.h"
#include "shading_fixture.h"

using namespace fixture;
using namespace relief::samples::triplanar;

namespace {

// A block of a plane through (0, 0, 5): x to the right, y up, seen from -z; `down` turns the rows around.
struct Block
{
    float3 normal, position;

    Block(float slopeX, float slopeY, bool upsideDown = false)
    {
        const Float x = Float(laneXs()) * 0.01f;
        const Float row = upsideDown ? Float(laneYs()) : static_cast<float>(kBlockHeight - 1) - Float(laneYs());
        const Float y = row * 0.01f;
        position = {x, y, 5.0f + x * slopeX + y * slopeY};
        normal = normalize(float3(slopeX, slopeY, -1.0f));
    }
};

const float3 kBump = normalize(float3(0.3f, -0.2f, 0.9f));

}  // namespace

TEST_CASE("cotangent frame: on a tilted plane it is what the projection's stretch says")
{
    for (const float slopeX : {0.0f, 0.5f, -1.0f}) {
        for (const float slopeY : {0.0f, -0.3f, 1.2f}) {
            const Block block(slopeX, slopeY);
            // In the coordinates of the z plane, seen from the side that the surface faces.
            const float3 surface = {block.normal.x, block.normal.y, abs(block.normal.z)};
            const auto back = [](const float3& v) { return lane(float3(v.x, v.y, -v.z)); };
            const float2 uv = block.position.xy() * 3.0f;
            CHECK(angle(lane(mul(cotangent_frame(block.normal, block.position, uv), kBump)),
                        back(CotangentFrame()(surface, kBump))) <= 1e-2);
            // Three repetitions per unit: gradients of 3.
            const float3 steep = {kBump.x * 3.0f, kBump.y * 3.0f, kBump.z};
            CHECK(angle(lane(mul(cotangent_gradients(block.normal, block.position, uv), kBump)),
                        back(CotangentGradients()(surface, steep))) <= 1e-2);
        }
    }
}

TEST_CASE("cotangent frame: S-656 a picture that is upside down has the same normals")
{
    for (const float slope : {0.0f, 0.7f, -1.5f}) {
        const Block up(slope, 0.4f), down(slope, 0.4f, true);
        const float3 a = perturb_normal(kBump, up.normal, up.position, up.position.xy());
        const float3 b = perturb_normal(kBump, down.normal, down.position, down.position.xy());
        measured("degrees between the two", angle(lane(a), lane(b)), 1e-4);
        // And the mirrored uv gives a mirrored bump, in both.
        const float3 mirrored = perturb_normal(kBump, up.normal, up.position, float2(-up.position.x, up.position.y));
        CHECK(angle(lane(a), lane(mirrored)) > 10.0);
    }
}

TEST_CASE("cotangent frame: S-655 without a frame the normal stays, to the bit")
{
    const Block block(0.5f, 0.2f);
    const Float u = block.position.x;
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const float2 without[] = {float2(0.0f),           float2(0.25f, -3.0f), float2(u, 0.0f),        float2(u, u * 2.0f),
                              float2(u, u * 0.3333f), float2(0.0f, u),      float2(nan, 0.0f),      float2(u, nan),
                              float2(infinity, u),    float2(u, infinity),  float2(u * 1e30f, 0.0f)};
    for (const float2& uv : without) {
        CHECK(sameBits(perturb_normal(kBump, block.normal, block.position, uv), block.normal));
    }
    for (const float3& position : {float3(0.0f), float3(1.0f, 2.0f, 3.0f), float3(u, u, u), float3(nan, 0.0f, 0.0f)}) {
        CHECK(sameBits(perturb_normal(kBump, block.normal, position, block.position.xy()), block.normal));
    }
    // A bump of nothing is no direction either.
    CHECK(sameBits(perturb_normal(float3(0.0f), block.normal, block.position, block.position.xy()), block.normal));
}

TEST_CASE("cotangent frame: very small and very large pixels and textures")
{
    for (const float pixel : {1e-6f, 1.0f, 1e6f}) {
        for (const float tiling : {1e-4f, 1.0f, 1e4f}) {
            const Block block(0.5f, 0.2f);
            const float3 position = block.position * pixel;
            const float2 uv = block.position.xy() * tiling;
            const Vector n = lane(perturb_normal(kBump, block.normal, position, uv));
            REQUIRE(isFinite(n));
            const Vector reference = lane(perturb_normal(kBump, block.normal, block.position, block.position.xy()));
            CHECK(angle(n, reference) <= 1e-2);
        }
    }
}

TEST_CASE("cotangent frame: S-503 a seam of uv spoils its own quads only, and not if uv is taken before it is wrapped")
{
    // u runs over 1 in the middle of the block's first quad.
    const Block block(0.5f, 0.2f);
    const float2 whole = {block.position.x + 0.995f, block.position.y};
    const float2 wrapped = {frac(whole.x), whole.y};
    const float3 before = perturb_normal(kBump, block.normal, block.position, whole);
    const float3 after = perturb_normal(kBump, block.normal, block.position, wrapped);
    const Vector reference = lane(before, kLanes - 1);
    for (int i = 0; i < kLanes; ++i) {
        measured("degrees off, uv from before the wrap", angle(lane(before, i), reference), 1e-2);
        REQUIRE(isFinite(lane(after, i)));
        CHECK(length(lane(after, i)) == doctest::Approx(1.0).epsilon(1e-6));
        if (laneX(i) >= 2) CHECK(angle(lane(after, i), reference) <= 1e-2);
    }
    CHECK(angle(lane(after, 0), reference) > 10.0);
}
