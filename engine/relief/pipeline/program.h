// A draw's two programs as the pipeline sees them: tables made from their structs, and three functions that run them on
// lanes: on vertices, on blocks of a batch of triangles, and on blocks that small triangles share. This is all that is
// compiled with a program. Everything else of the pipeline is compiled once, in the engine.
//
//     VertexData  ->  vertex program  ->  Interpolators  ->  fragment program  ->  float4, or a struct of outputs
#pragma once

#include <bit>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

#include "relief/hlsl/signature.h"
#include "relief/leave_out.h"
#include "relief/pipeline/interpolate.h"
#include "relief/pipeline/raster.h"
#include "relief/pipeline/shared_block.h"
#include "relief/texture/shading_scope.h"

namespace relief::inline RELIEF_WIDTH {

// A fragment program that takes this as its second parameter may throw pixels away:
//
//     discard(color.a < 0.5f);
//     if (discard.all()) return 0.0f;  // no pixel of this block is left: leave out the rest
class Discard
{
public:
    void operator()(Mask where) { discarded |= where; }

    // No pixel is left of those that the program runs for.
    bool all() const { return leavesOut::discarded && (shading.activeLanes & ~discarded.bits()) == 0; }

    Mask discarded = false;
};

// --- what runs ---

// kLanes vertices: what the streams hold, four words for each field of VertexData, and what the vertex program makes of
// them: the position, and as many components as the interpolators have.
struct VertexLanes
{
    Float in[kMaxFields][4];
    float4 position;
    Float components[kMaxComponents];
};

// What a fragment program gives beside the colour of target 0. Only what its struct has is written.
struct MoreOutputs
{
    alignas(Float) float color[kMaxColors - 1][4][kLanes];  // of targets 1 ... 3
    alignas(Float) float depth[kLanes];
    alignas(Float) std::int32_t coverage[kLanes];
};

// A block of pixels that a fragment program runs on. Lanes lie here as plain numbers, to be loaded and stored one
// vector at a time: g++ 12 would copy a struct of them in smaller pieces, which the next load of a whole vector has to
// wait for.
struct ShadedBlock
{
    alignas(Float) float edge[3][kLanes];      // the edge functions at its pixels, if there is anything to interpolate
    alignas(Float) float centroid[3][kLanes];  // and at their centroids, if the program asks for them
    alignas(Float) float color[4][kLanes];     // what the program gives target 0
    MoreOutputs* more;                         // room for what else it gives, if it does
    unsigned discarded;                        // what it throws away, a bit per lane
    unsigned live;                             // pixels whose result counts
    unsigned quads;                            // those with such a pixel, whole
    int index;                                 // in the tile
    CoveredBlock covered;                      // its coverage: the lanes whose pixel's centre is in the triangle
    SampleCoverage liveSamples;                // where a pixel has several: of each, the lanes where it counts
};

// The components of a triangle's three corners, and which side of it is seen.
struct TriangleCorners
{
    const float* components[3];
    bool isFront;
};

// A copy of a program, or anything else, whose type is forgotten; and how to make one.
using ErasedProgram = std::unique_ptr<const void, void (*)(const void*)>;

struct ProgramCopier
{
    const void* (*copy)(const void* program);
    void (*destroy)(const void* copied);

    ErasedProgram operator()(const void* program) const { return {copy(program), destroy}; }
};

// What a fragment program gives.
struct Outputs
{
    unsigned targets;  // a bit for each colour
    bool depth, coverage;

    bool more() const { return targets > 1 || depth || coverage; }
};

struct Programs
{
    Fields vertexData, interpolators;
    int components;  // to interpolate: all but SV_POSITION's
    bool discards;
    Outputs outputs;
    ProgramCopier copyVertexProgram, copyFragmentProgram;

    void (*shadeVertices)(const void* vertexProgram, VertexLanes& vertices);

    // Blocks of one batch; `corners` has an element for each of its triangles.
    void (*shadeBlocks)(const void* fragmentProgram, std::span<ShadedBlock> blocks, const TriangleBatch& batch,
                        const TriangleCorners* corners);

    // The same blocks in shared ones. Null where the program takes none.
    void (*shadeShared)(const void* fragmentProgram, std::span<const SharedBlock> shared, ShadedBlock* blocks,
                        const TriangleBatch& batch, const TriangleCorners* corners);
};

namespace detail {

// What can be taken as a float4.
template <class T>
concept IsColor = requires(T&& value, void (&take)(float4))
{
    take(static_cast<T&&>(value));
};

// That, or a struct of SV_Target<n>, SV_Depth, SV_Coverage: at least one of them.
template <class T>
constexpr bool isColorOrOutputs()
{
    if constexpr (IsColor<T>) {
        return true;
    } else if constexpr (!std::is_class_v<T>) {
        return false;
    } else if constexpr (fieldCount<T>() <= 0) {
        return false;
    } else {
        using Fields = FieldsOf<T>;
        return meanOnly<SystemValue::target, SystemValue::depth, SystemValue::coverage>(Fields{}) &&
               !namesTwice(Fields{}) && indicesWith<SystemValue::target>(Fields{}) < 1u << kMaxColors;
    }
}

// What a fragment program gives, and whether it may throw pixels away; void if it is none for these Interpolators.
template <class Given, bool throwsAway>
struct FragmentTypes
{
    using Result = Given;
    static constexpr bool kDiscards = throwsAway;
};
template <class FragmentProgram, class Interpolators>
auto fragmentTypes()
{
    // clang-format off
    if constexpr (requires(const FragmentProgram& p, Interpolators&& i, Discard& d) { p(static_cast<Interpolators&&>(i), d); }) {
        return FragmentTypes<decltype(std::declval<const FragmentProgram&>()(std::declval<Interpolators>(), std::declval<Discard&>())), true>{};
    } else if constexpr (requires(const FragmentProgram& p, Interpolators&& i) { p(static_cast<Interpolators&&>(i)); }) {
        return FragmentTypes<decltype(std::declval<const FragmentProgram&>()(std::declval<Interpolators>())), false>{};
    } else {
        return FragmentTypes<void, false>{};
    }
    // clang-format on
}
template <class FragmentProgram, class Interpolators>
using FragmentTypesOf = decltype(fragmentTypes<FragmentProgram, Interpolators>());

template <class Result>
constexpr Outputs outputsOf()
{
    if constexpr (IsColor<Result>) {
        return {1, false, false};
    } else {
        using Fields = FieldsOf<Result>;
        return {indicesWith<SystemValue::target>(Fields{}), componentsWith<SystemValue::depth>(Fields{}) > 0,
                componentsWith<SystemValue::coverage>(Fields{}) > 0};
    }
}

// What a fragment program gives for a block. `of` makes a colour's lanes of the program's: depth and coverage are never
// shared.
template <class Result, class Of>
void storeOutputs(Result&& result, ShadedBlock& block, const Of& of)
{
    const auto storeColor = [&of](const float4& color, float(&to)[4][kLanes]) {
        of(color.x).store(to[0]);
        of(color.y).store(to[1]);
        of(color.z).store(to[2]);
        of(color.w).store(to[3]);
    };
    if constexpr (IsColor<Result>) {
        storeColor(result, block.color);
    } else {
        forEachField(result, [&]<class Field>(Field& field) {
            if constexpr (Field::kSystemValue == SystemValue::depth) {
                static_cast<const Float&>(field).store(block.more->depth);
            } else if constexpr (Field::kSystemValue == SystemValue::coverage) {
                static_cast<const Int&>(field).store(block.more->coverage);
            } else if constexpr (Field::kIndex == 0) {
                storeColor(field, block.color);
            } else {
                storeColor(field, block.more->color[Field::kIndex - 1]);
            }
        });
    }
}
template <class Result>
void storeOutputs(Result&& result, ShadedBlock& block)
{
    storeOutputs(static_cast<Result&&>(result), block, [](Float its) { return its; });
}

// A live compile (samples/live) inlines less: g++ then takes half the time, and the bits are the same.
#if !defined(RELIEF_FLATTEN)
#define RELIEF_FLATTEN [[gnu::flatten]]
#endif

template <class VertexData, class Interpolators, class VertexProgram>
RELIEF_FLATTEN void shadeVertices(const void* vertexProgram, VertexLanes& vertices)
{
    VertexData data;
    int field = 0;
    forEachField(data, [&]<class F>(F& value) {
        for (int c = 0; c < kComponents<typename F::Value>; ++c)
            setWord(component(static_cast<typename F::Value&>(value), c), vertices.in[field][c]);
        ++field;
    });
    Interpolators result = (*static_cast<const VertexProgram*>(vertexProgram))(data);
    int slot = 0;
    forEachField(result, [&]<class F>(F& value) {
        if constexpr (F::kIsPosition) {
            vertices.position = value;
        } else if constexpr (F::kIsInterpolated) {
            for (int c = 0; c < kComponents<typename F::Value>; ++c)
                vertices.components[slot++] = wordOf(component(static_cast<typename F::Value&>(value), c));
        }
    });
}

inline BlockPixels pixelsOf(const ShadedBlock& block)
{
    const auto& e = block.edge;
    const auto& c = block.centroid;
    return {{Float::load(e[0]), Float::load(e[1]), Float::load(e[2])},
            {Float::load(c[0]), Float::load(c[1]), Float::load(c[2])},
            laneXs() + block.covered.x,
            laneYs() + block.covered.y,
            block.covered.coverage};
}

template <class Interpolators, class FragmentProgram, int components>
void shadeBlock(const FragmentProgram& program, const TriangleWeights& triangle, const TriangleEdges& edges,
                const CornerComponents<components>& corners, bool isFront, ShadedBlock& block)
{
    shading.activeLanes = block.quads;
    const auto input = [&] {
        BlockPixels pixels = pixelsOf(block);
        // Where nothing is interpolated, SV_POSITION alone may want to know the edges: the compiler sees whether it
        // does.
        if constexpr (components == 0) edges.at(block.covered.x, block.covered.y, pixels.edge);
        return interpolate<Interpolators>(triangle, corners, isFront, pixels);
    };
    if constexpr (FragmentTypesOf<FragmentProgram, Interpolators>::kDiscards) {
        Discard discard;
        storeOutputs(program(input(), discard), block);
        block.discarded = discard.discarded.bits();
    } else {
        storeOutputs(program(input()), block);
    }
}

template <class Interpolators, class FragmentProgram>
RELIEF_FLATTEN void shadeBlocks(const void* fragmentProgram, std::span<ShadedBlock> blocks, const TriangleBatch& batch,
                                const TriangleCorners* corners)
{
    const FragmentProgram& program = *static_cast<const FragmentProgram*>(fragmentProgram);
    CornerComponents<interpolatedComponents(FieldsOf<Interpolators>{})> components;
    TriangleWeights triangle;
    TriangleEdges edges;
    ShadedBlock* next = blocks.data();
    ShadedBlock* const end = next + blocks.size();
    while (next != end) {
        const int current = next->covered.triangle;
        const auto& [a, b, c] = corners[current].components;
        const bool isFront = corners[current].isFront;
        components.set(a, b, c);
        triangle.set(batch, current);
        if constexpr (components.kCount == 0) edges.set(batch, current);
        do {
            shadeBlock<Interpolators>(program, triangle, edges, components, isFront, *next);
        } while (++next != end && next->covered.triangle == current);
    }
}

// Calls visit(part, its way) for each part of a shared block.
template <class Visit>
void forEachPart(const SharedBlock& shared, ShadedBlock* blocks, const Visit& visit)
{
    int taken = 0;
    for (std::size_t i = 0; i < shared.count; ++i) {
        ShadedBlock& part = blocks[shared.parts[i]];
        visit(part, WayOfQuads(part.quads, taken));
        taken += countBits(part.quads);
    }
}

// The pixels of a shared block; lanes that are no part's are like the first one's. Calls tell(triangle, its lanes) for
// each part.
template <class Tell>
BlockPixels pixelsOf(const SharedBlock& shared, ShadedBlock* blocks, const Tell& tell)
{
    BlockPixels whole = pixelsOf(blocks[shared.parts[0]]);
    if (shared.count == 1) {  // nothing moves
        tell(blocks[shared.parts[0]].covered.triangle, blocks[shared.parts[0]].quads);
        return whole;
    }
    forEachPart(shared, blocks, [&](const ShadedBlock& block, const WayOfQuads& way) {
        const BlockPixels part = pixelsOf(block);
        for (int k = 0; k < 3; ++k) {
            whole.edge[k] = way.there(part.edge[k], whole.edge[k]);
            whole.centroid[k] = way.there(part.centroid[k], whole.centroid[k]);
        }
        whole.x = way.there(part.x, whole.x);
        whole.y = way.there(part.y, whole.y);
        whole.covered = way.there(Mask::fromBits(part.covered), Mask::fromBits(whole.covered)).bits();
        tell(block.covered.triangle, way.lanes());
    });
    return whole;
}

// Takes these lanes of another input.
template <class Interpolators>
void takeLanes(Interpolators& input, Interpolators& other, Mask lanes)
{
    const auto take = [lanes]<class F>(F& to, F& from) {
        if constexpr (F::kSystemValue == SystemValue::facing) {
            to = F((lanes & from) | (!lanes & to));
        } else {
            using Value = typename F::Value;
            for (int c = 0; c < kComponents<Value>; ++c) {
                auto& its = component(static_cast<Value&>(to), c);
                its = select(lanes, component(static_cast<Value&>(from), c), its);
            }
        }
    };
    withFields(input, [&](auto&... to) { withFields(other, [&](auto&... from) { (take(to, from), ...); }); });
}

// A function of its own: with blocks of both kinds in one, its input would come from two places, and those that are not
// shared would wait for it. So the program is compiled twice.
template <class Interpolators, class FragmentProgram>
RELIEF_FLATTEN void shadeShared(const void* fragmentProgram, std::span<const SharedBlock> shared, ShadedBlock* blocks,
                                const TriangleBatch& batch, const TriangleCorners* corners)
{
    const FragmentProgram& program = *static_cast<const FragmentProgram*>(fragmentProgram);
    // The parts are of few triangles, in any order.
    TriangleWeights triangles[kLanes];
    CornerComponents<interpolatedComponents(FieldsOf<Interpolators>{})> components[kLanes];
    unsigned known = 0;
    for (const SharedBlock& block : shared) {
        unsigned lanesOf[kLanes] = {}, seen = 0, lanes = 0;
        const BlockPixels pixels = pixelsOf(block, blocks, [&](int triangle, unsigned its) {
            lanesOf[triangle] |= its;
            seen |= 1u << triangle;
            lanes |= its;
        });
        Interpolators input;
        for (unsigned rest = seen; rest != 0; rest &= rest - 1) {
            const int triangle = std::countr_zero(rest);
            if ((known >> triangle & 1u) == 0) {
                const auto& [a, b, c] = corners[triangle].components;
                components[triangle].set(a, b, c);
                triangles[triangle].set(batch, triangle);
                known |= 1u << triangle;
            }
            Interpolators its = interpolate<Interpolators>(triangles[triangle], components[triangle],
                                                           corners[triangle].isFront, pixels);
            takeLanes(input, its, Mask::fromBits(lanesOf[triangle]));
        }
        shading.activeLanes = lanes;
        auto result = program(std::move(input));
        if (block.count == 1) {  // nothing has moved
            storeOutputs(result, blocks[block.parts[0]]);
            continue;
        }
        forEachPart(block, blocks, [&](ShadedBlock& part, const WayOfQuads& way) {
            storeOutputs(result, part, [&way](Float its) { return way.back(its); });
        });
    }
}

// Not with nothing to interpolate, when a program is soon done; and not where it decides which pixels are drawn, for
// then it runs block by block. A live compile compiles it once.
template <class Interpolators, class FragmentProgram>
constexpr auto sharedShader() -> decltype(Programs::shadeShared)
{
#if !defined(RELIEF_LIVE)
    using Types = FragmentTypesOf<FragmentProgram, Interpolators>;
    constexpr Outputs outputs = outputsOf<typename Types::Result>();
    if constexpr (kQuads > 1 && interpolatedComponents(FieldsOf<Interpolators>{}) > 0 && !Types::kDiscards &&
                  !outputs.depth && !outputs.coverage)
        return shadeShared<Interpolators, FragmentProgram>;
#endif
    return nullptr;
}

// --- what a program must look like; a failure names the sentence that is not met ---

// Whether the compiler joins a product and a sum into one rounding in this file, which would give its programs bits of
// their own. One for each file, on purpose.
static inline bool contractsProducts()
{
    volatile float one = 1.0f + 0x1p-12f, square = one * one;
    const float a = one, b = square;
    return a * a - b != 0.0f;
}

// A type without const and &. The standard's traits, here and below, would each cost a compiler that reads precompiled
// headers more than the check itself: with one of them it loads all that was made of it.
template <class T>
struct Bare
{
    using Type = T;
};
template <class T>
struct Bare<const T> : Bare<T>
{
};
template <class T>
struct Bare<T&> : Bare<T>
{
};
template <class T>
struct Bare<T&&> : Bare<T>
{
};

// The structs that a vertex program takes and gives; void if it is no vertex program.
template <class Operator>
struct VertexTypesOf
{
    using VertexData = void;
    using Interpolators = void;
};
template <class Result, class Program, class Parameter>
struct VertexTypesOf<Result (Program::*)(Parameter) const>
{
    using VertexData = typename Bare<Parameter>::Type;
    using Interpolators = typename Bare<Result>::Type;
};
template <class Result, class Program, class Parameter>
struct VertexTypesOf<Result (Program::*)(Parameter) const noexcept>
    : VertexTypesOf<Result (Program::*)(Parameter) const>
{
};
template <class VertexProgram>
auto vertexTypes()
{
    if constexpr (requires { &VertexProgram::operator(); }) {
        return VertexTypesOf<decltype(&VertexProgram::operator())>{};
    } else {
        return VertexTypesOf<void>{};  // a template, or several of them
    }
}
template <class VertexProgram>
using VertexDataFor = typename decltype(vertexTypes<VertexProgram>())::VertexData;
template <class VertexProgram>
using InterpolatorsFor = typename decltype(vertexTypes<VertexProgram>())::Interpolators;

template <class FragmentProgram, class Interpolators>
constexpr bool checkInterpolators()
{
    using Fields = FieldsOf<Interpolators>;
    constexpr bool hasOnePosition = positionCount(Fields{}) == 1;
    constexpr bool isFewEnough = interpolatedComponents(Fields{}) <= kMaxComponents;
    constexpr bool namesOnce = !hasOnePosition || !namesTwice(Fields{});
    constexpr bool integersFlat = integersAreFlat(Fields{});
    constexpr bool clipsFewEnough = componentsWith<SystemValue::clipDistance>(Fields{}) <= kMaxClipDistances;
    static_assert(hasOnePosition,
                  "Interpolators must have exactly one SV_POSITION: the vertex program's clip-space position");
    static_assert(isFewEnough, "Interpolators may have at most 128 components");
    static_assert(namesOnce, "a semantic and its index may stand only once among the Interpolators");
    static_assert(integersFlat, "integers among the Interpolators must be nointerpolation<...>");
    static_assert(clipsFewEnough, "SV_ClipDistance may have at most 8 components in all");
    if constexpr (hasOnePosition && isFewEnough && namesOnce && integersFlat && clipsFewEnough) {
        using Result = typename FragmentTypesOf<FragmentProgram, Interpolators>::Result;
        constexpr bool takesInterpolators = isColorOrOutputs<Result>();
        static_assert(takesInterpolators,
                      "the fragment program must take the Interpolators that the vertex program returns, and return "
                      "float4, or a struct of SV_Target<0> ... SV_Target<3>, SV_Depth, SV_Coverage");
        return takesInterpolators;
    }
    return false;
}

// Whether a type is a struct of semantics that mean nothing else to the pipeline.
template <class Struct, SystemValue... meanings>
constexpr bool isStructOf()
{
    if constexpr (fieldCount<Struct>() >= 0) {
        return meanOnly<meanings...>(FieldsOf<Struct>{});
    } else {
        return false;
    }
}

// Whether two programs and their structs belong together. A mistake is one sentence in the compiler's output: every
// check has a name, which clang prints, and what would fail for the same reason is not compiled after it.
template <class VertexProgram, class FragmentProgram>
constexpr bool checkPrograms()
{
    using VertexData = VertexDataFor<VertexProgram>;
    constexpr bool isVertexProgram = !std::is_same_v<VertexData, void>;
    static_assert(isVertexProgram, "a vertex program must have: Interpolators operator()(VertexData v) const");
    if constexpr (isVertexProgram) {
        using Interpolators = InterpolatorsFor<VertexProgram>;
        using enum SystemValue;
        constexpr bool vertexDataIsSemantics = isStructOf<VertexData, none, id, position>();
        constexpr bool interpolatorsAreSemantics = isStructOf<Interpolators, none, position, facing, clipDistance>();
        static_assert(vertexDataIsSemantics,
                      "every field of VertexData (at most 12, no arrays, no base class) must be a semantic: "
                      "POSITION, NORMAL, TANGENT, TEXCOORD<n, float2>, COLOR<n, float4>, SV_VertexID, SV_InstanceID");
        static_assert(interpolatorsAreSemantics,
                      "every field of Interpolators (at most 12, no arrays, no base class) must be a semantic: "
                      "SV_POSITION, TEXCOORD<n, float4>, COLOR<n, float4>, SV_ClipDistance<n, float4>, SV_IsFrontFace");
        if constexpr (vertexDataIsSemantics && interpolatorsAreSemantics) {
            constexpr bool vertexDataHasNoScreen = positionCount(FieldsOf<VertexData>{}) == 0;
            constexpr bool vertexDataNamesOnce = !namesTwice(FieldsOf<VertexData>{});
            static_assert(vertexDataHasNoScreen, "VertexData holds POSITION; SV_POSITION is what the program gives");
            static_assert(vertexDataNamesOnce, "a semantic and its index may stand only once in VertexData");
            return vertexDataHasNoScreen && vertexDataNamesOnce && checkInterpolators<FragmentProgram, Interpolators>();
        }
    }
    return false;
}

template <class Program>
inline constexpr ProgramCopier kCopier = {
    [](const void* program) -> const void* { return new Program(*static_cast<const Program*>(program)); },
    [](const void* copied) { delete static_cast<const Program*>(copied); },
};

template <class VertexProgram, class FragmentProgram, class VertexData = VertexDataFor<VertexProgram>,
          class Interpolators = InterpolatorsFor<VertexProgram>>
inline constexpr Programs kPrograms = {
    kFields<VertexData>,
    kFields<Interpolators>,
    interpolatedComponents(FieldsOf<Interpolators>{}),
    FragmentTypesOf<FragmentProgram, Interpolators>::kDiscards,
    outputsOf<typename FragmentTypesOf<FragmentProgram, Interpolators>::Result>(),
    kCopier<VertexProgram>,
    kCopier<FragmentProgram>,
    shadeVertices<VertexData, Interpolators, VertexProgram>,
    shadeBlocks<Interpolators, FragmentProgram>,
    sharedShader<Interpolators, FragmentProgram>(),
};

// Where a draw finds them. A live compile divides a file's programs among several compilers (samples/live/parts.h).
#if defined(RELIEF_LIVE)
template <class VertexProgram, class FragmentProgram>
const Programs& programsOf();
#else
template <class VertexProgram, class FragmentProgram>
constexpr const Programs& programsOf()
{
    return kPrograms<VertexProgram, FragmentProgram>;
}
#endif

}  // namespace detail

}  // namespace relief::inline RELIEF_WIDTH
