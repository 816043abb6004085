// The output-signature table: the two that the tangent-space tutorial shows, and how registers are shared.
#include "relief/hlsl/signature.h"

#include <string>

#include <doctest/doctest.h>

using namespace relief;

namespace {

const std::string kHead =
    "// Output signature:\n"
    "//\n"
    "// Name                 Index   Mask Register SysValue  Format   Used\n"
    "// -------------------- ----- ------ -------- -------- ------- ------\n";

struct BinormalPerVertex
{
    SV_POSITION position;
    TEXCOORD<0, float4> uv;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float3> tangent;
    TEXCOORD<3, float3> binormal;
    TEXCOORD<4, float3> worldPos;
};

struct BinormalPerFragment
{
    SV_POSITION position;
    TEXCOORD<0, float4> uv;
    TEXCOORD<1, float3> normal;
    TEXCOORD<2, float4> tangent;
    TEXCOORD<4, float3> worldPos;
};

}  // namespace

TEST_CASE("signature: binormal per vertex")
{
    CHECK(signature<BinormalPerVertex>() ==
          kHead +
              "// SV_POSITION              0   xyzw        0      POS   float   xyzw\n"
              "// TEXCOORD                 0   xyzw        1     NONE   float   xyzw\n"
              "// TEXCOORD                 1   xyz         2     NONE   float   xyz\n"
              "// TEXCOORD                 2   xyz         3     NONE   float   xyz\n"
              "// TEXCOORD                 3   xyz         4     NONE   float   xyz\n"
              "// TEXCOORD                 4   xyz         5     NONE   float   xyz\n");
}

TEST_CASE("signature: binormal per fragment, with an index left out")
{
    CHECK(signature<BinormalPerFragment>() ==
          kHead +
              "// SV_POSITION              0   xyzw        0      POS   float   xyzw\n"
              "// TEXCOORD                 0   xyzw        1     NONE   float   xyzw\n"
              "// TEXCOORD                 1   xyz         2     NONE   float   xyz\n"
              "// TEXCOORD                 2   xyzw        3     NONE   float   xyzw\n"
              "// TEXCOORD                 4   xyz         4     NONE   float   xyz\n");
}

TEST_CASE("signature: a smaller field takes the components that an earlier register has left")
{
    struct Interpolators
    {
        SV_POSITION position;
        TEXCOORD<0, float2> uv;
        TEXCOORD<1, float3> normal;
        TEXCOORD<2, Float> fade;
        TEXCOORD<3, Float> height;
        COLOR<1, Float> light;
        TEXCOORD<4, Float> more;
    };
    CHECK(signature<Interpolators>() == kHead +
                                            "// SV_POSITION              0   xyzw        0      POS   float   xyzw\n"
                                            "// TEXCOORD                 0   xy          1     NONE   float   xy\n"
                                            "// TEXCOORD                 1   xyz         2     NONE   float   xyz\n"
                                            "// TEXCOORD                 2     z         1     NONE   float     z\n"
                                            "// TEXCOORD                 3      w        1     NONE   float      w\n"
                                            "// COLOR                    1      w        2     NONE   float      w\n"
                                            "// TEXCOORD                 4   x           3     NONE   float   x\n");
}

TEST_CASE("signature: two pairs share a register")
{
    struct Interpolators
    {
        SV_POSITION position;
        TEXCOORD<0, float2> uv;
        TEXCOORD<1, float2> detailUv;
    };
    CHECK(signature<Interpolators>().find("// TEXCOORD                 1     zw        1     NONE   float     zw\n") !=
          std::string::npos);
}

TEST_CASE("signature: a field that does not fit into what is left starts a register")
{
    struct Interpolators
    {
        SV_POSITION position;
        TEXCOORD<0, float3> normal;
        TEXCOORD<1, float2> uv;
    };
    CHECK(signature<Interpolators>().find("// TEXCOORD                 1   xy          2     NONE   float   xy\n") !=
          std::string::npos);
}

TEST_CASE("signature: a register is interpolated in one way")
{
    struct Interpolators
    {
        SV_POSITION position;
        TEXCOORD<0, float3> normal;
        noperspective<TEXCOORD<1, Float>> fade;
        TEXCOORD<2, Float> height;
        noperspective<TEXCOORD<3, float2>> screenUv;
    };
    CHECK(signature<Interpolators>() == kHead +
                                            "// SV_POSITION              0   xyzw        0      POS   float   xyzw\n"
                                            "// TEXCOORD                 0   xyz         1     NONE   float   xyz\n"
                                            "// TEXCOORD                 1   x           2     NONE   float   x\n"
                                            "// TEXCOORD                 2      w        1     NONE   float      w\n"
                                            "// TEXCOORD                 3    yz         2     NONE   float    yz\n");
}

TEST_CASE("signature: registers follow the order of the fields, not the indices")
{
    struct Interpolators
    {
        TEXCOORD<7, float4> late;
        SV_POSITION position;
        TEXCOORD<0, float4> early;
    };
    CHECK(signature<Interpolators>() == kHead +
                                            "// TEXCOORD                 7   xyzw        0     NONE   float   xyzw\n"
                                            "// SV_POSITION              0   xyzw        1      POS   float   xyzw\n"
                                            "// TEXCOORD                 0   xyzw        2     NONE   float   xyzw\n");
}

TEST_CASE("signature: a struct without fields is the head alone")
{
    struct Nothing
    {
    };
    CHECK(signature<Nothing>() == kHead);
}
