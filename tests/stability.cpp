// The table of all stability cases, what collects their tests' numbers, and the check that table and tests agree.
#include "stability.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/pattern.h"
#include "contents.h"

namespace stability {

namespace {

using relief::samples::Match;
using relief::samples::Pattern;

constexpr const char* kTested = nullptr;

// clang-format off
constexpr Case kCases[] = {
    // --- vertices ---
    {"S-101", "a NaN in x, y, z or w", "its bounding box covers the screen", "dropped and counted; the picture is the one without it", kTested},
    {"S-102", "an infinity in a position", "infinity minus infinity is NaN in the clipper", "dropped and counted by itself", kTested},
    {"S-103", "coordinates of 1e30 and 3.4e34, others in view", "products overflow, conversion to int gives INT_MIN", "visible edges within 1/32 px of clipping in double", kTested},
    {"S-104", "w = 0 in one, two, three corners", "division by zero", "cut at w > 0 before any division; three: nothing", kTested},
    {"S-105", "all w < 0", "a mirrored ghost", "0 pixels", kTested},
    {"S-106", "w subnormal or the smallest normal number", "1/w is infinite", "behind the eye: 0 pixels, no NaN", kTested},
    {"S-107", "model matrix of scale (1,1,0), (0,0,0), of rank 1", "its inverse is infinite", "normals of (1,1,0) are +-z within 1e-4 degrees; no NaN", kTested},
    {"S-108", "model matrix that mirrors", "inside out, bumps inverted", "the mirrored normals within 1e-4 degrees, the same pixels", kTested},
    {"S-109", "scale 1000:1 and 1e6:1", "normals by the matrix of the positions", "1000:1 within 0.0137 degrees; 1e6:1 of unit length", kTested},
    {"S-110", "objects 1e6 and 1e7 from the origin", "positions are multiples of 1/16 and 1: they jump", "at 1e6, with the camera subtracted in double, within 1/256 px", kTested},
    {"S-111", "vertex normals of length 0 and 1e-30, NaN", "NaN", "1e-30: unit within 4 ulp; no direction: the zero vector, no light, no NaN", kTested},
    {"S-112", "indices (i,i,j), beyond the vertices, no vertices, a million equal ones", "division by an area of 0, reads past the end", "culled or dropped, and counted", kTested},
    {"S-113", "viewports 0x0, 1x1, 1x4096, odd, partly outside", "the last tile is overrun", "the pixels of the same viewport in a larger target", kTested},
    {"S-114", "near = far, near < 0, 179.9 degrees, aspect 1e6", "an infinite matrix", "finite picture", kTested},
    // --- clipping ---
    {"S-201", "a corner a hair inside of the near plane", "the cut lies beyond the edge's end", "within the edge's box", kTested},
    {"S-202", "two triangles whose shared edge is cut", "cut twice, differently: a crack", "the same bits; each pixel once", kTested},
    {"S-203", "a triangle through all six planes", "an array of 7 corners overflows", "at most 9 corners; every pixel covered", kTested},
    {"S-204", "corners on a plane", "repeated corners, fans without area", "on a plane is inside; no corner twice", kTested},
    {"S-205", "clipping at the viewport or at the guard band", "the picture depends on which", "the same but for centres within 1/32 px of an edge", kTested},
    {"S-206", "the fan of a clipped polygon, blended", "inner edges are hit twice", "each pixel once", kTested},
    {"S-207", "z outside, depth clipping off", "z > 1 wraps in fixed point", "drawn, with depth 0 or 1 exactly", kTested},
    {"S-208", "z exactly 0 and 1", "dropped by < instead of <=", "kept", kTested},
    {"S-209", "a NaN in a user's clip distance", "undefined", "outside: cut off, and nothing else changes", kTested},
    {"S-210", "a triangle cut a thousand times", "attributes drift", "off by at most 16 * 2^-24 of the largest", kTested},
    {"S-211", "several samples a pixel, cut by the near plane", "samples lost or hit twice along the cut", "as many as an exact cut has, but for 1/32 px along edges; none twice", kTested},
    // --- setup and coverage ---
    {"S-301", "random triangulations of a square", "holes and double hits", "every pixel once", kTested},
    {"S-302", "fans whose common corner is a pixel centre", "0 or n hits there", "1 hit", kTested},
    {"S-303", "triangles without area, also by snapping", "1 / area is infinite", "culled first, and counted", kTested},
    {"S-304", "half of 1/65536 px^2", "gradients overflow", "finite", kTested},
    {"S-305", "slivers of 1/256 px", "pixels dropped or doubled", "exactly what integer arithmetic says; pairs tile their union", kTested},
    {"S-306", "a mesh of a million triangles of 0.3 px", "lost pixels", "each centre once", kTested},
    {"S-307", "triangles that snapping turns over", "negative weights", "facing is decided after snapping", kTested},
    {"S-308", "T-junctions", "they crack; so they must", "no crack wider than 1 px", kTested},
    {"S-309", "both windings, the picture upside down", "top and left swapped", "the mirrored picture", kTested},
    {"S-310", "moved by whole pixels", "other roundings, other edges", "the same bits", kTested},
    {"S-311", "tiles of 8 to 128 px", "corners of tiles rejected wrongly", "the same picture", kTested},
    {"S-312", "edges on tile borders", "counted in both tiles, or in none", "every pixel once", kTested},
    {"S-313", "ties of snapping, on both sides of 0", "truncation makes the grid asymmetric", "nearest, ties to even", kTested},
    {"S-314", "coordinates above 2^31 px", "INT_MIN", "clamped to the guard band first", kTested},
    {"S-315", "triangles of 60000 px", "32 bits overflow: 49 are needed", "exactly what integer arithmetic says", kTested},
    {"S-316", "S-301 with several samples per pixel", "samples that belong to two pixels", "each sample once", kTested},
    {"S-317", "scissors: empty, inverted, outside, 1 px", "loops wrap around", "nothing, or that pixel", kTested},
    {"S-318", "targets 1xN, Nx1, 3x3", "quads reach outside", "every pixel once, none beyond", kTested},
    {"S-319", "a quad of two triangles known to leave a diagonal hole", "a hole", "21 + 15 pixels", kTested},
    {"S-320", "10000 triangles on one pixel", "bins overflow", "as drawn one by one", kTested},
    // --- interpolation ---
    {"S-401", "2 px far from the origin, w ratio 1e4", "u off by 0.5 by plane equations about the origin", "off by at most 8 * 2^-24", kTested},
    {"S-402", "a value equal at all corners", "it drifts", "unchanged, helper lanes too", kTested},
    {"S-403", "any attribute", "leaves the range of its corners", "at most 4 * 2^-24 beyond", kTested},
    {"S-404", "equal w", "perspective differs from affine", "at most 2 ulp", kTested},
    {"S-405", "one corner's attribute NaN, infinite, 1e38", "spreads to neighbours", "that triangle's pixels alone, replaced and counted", kTested},
    {"S-406", "subnormal attributes", "flushed to 0", "kept", kTested},
    {"S-407", "w from 1e-30 to 1e38", "0/0", "off by at most 8 * 2^-24", kTested},
    {"S-408", "attributes that are not interpolated", "interpolated constants change", "the bits of a corner", kTested},
    {"S-409", "opposite normals at two corners", "their middle has no direction: NaN", "finite; no direction is no light", kTested},
    {"S-410", "an attribute at the centre of a partly covered pixel", "out of range", "with centroid at a covered sample", kTested},
    {"S-411", "attributes in 16-bit floats", "infinite above 65504", "as 32 bits", "attributes are 32-bit floats"},
    {"S-412", "a triangle of 16384 px", "an error that grows from pixel to pixel", "S-401's bound at the last pixel", kTested},
    // --- derivatives and level of detail ---
    {"S-501", "helper lanes behind the horizon", "u is infinite, or of the other sign", "finite", kTested},
    {"S-502", "one covered pixel in a quad", "derivatives of garbage", "the triangle's own slope", kTested},
    {"S-503", "a seam of u inside a triangle", "a line of pixels at the smallest level", "uv or gradients from before the wrap: no line", kTested},
    {"S-504", "constant uv", "log2(0)", "minLod, ratio 1", kTested},
    {"S-505", "derivatives NaN and infinite", "an index from NaN", "maxLod", kTested},
    {"S-506", "parallel derivatives", "the ratio is infinite", "ratio 2.828, level -2.5 for (2,2), (2,2)", kTested},
    {"S-507", "a million derivatives, one grows", "the level falls", "never", kTested},
    {"S-508", "the same", "levels off", "between the two limits of the longest derivative, within 2^-8", kTested},
    {"S-509", "levels around a whole number", "a step", "none", kTested},
    {"S-510", "bias 1e30 and NaN, minLod > maxLod", "a level below 0", "within the levels; minLod wins", kTested},
    {"S-511", "level 1e9", "reads past the last level", "the last level", kTested},
    {"S-512", "the rows below the horizon", "levels jump between quads", "log2(1 + 1/D) off, as differences must be", kTested},
    {"S-513", "uv of 1e7", "noise", "a level within the texture's", kTested},
    {"S-514", "quads cut by tile or scissor", "derivatives from lanes that did not run", "lanes do not depend on which of them count", kTested},
    {"S-515", "sampling in a branch", "lanes that are off hold old data", "as without the branch, to the bit", kTested},
    {"S-516", "coarse against fine derivatives", "the picture changes in silence", "a choice by name; equal on a plane", kTested},
    // --- textures ---
    {"S-551", "u of 1e7, 3e9, 1e30", "u * N overflows an int", "the texel of exact arithmetic", kTested},
    {"S-552", "u NaN, infinite", "index INT_MIN", "texel 0, or the border", kTested},
    {"S-553", "u = -1e-8", "u - floor(u) is 1: index N", "0 ... N-1", kTested},
    {"S-554", "u = k/N", "the texel beside it", "texel k", kTested},
    {"S-555", "bilinear at a texel's centre", "a share of its neighbour", "that texel", kTested},
    {"S-556", "textures 1x1, 1xN", "N - 1 = 0", "constant; as many levels as the longer side", kTested},
    {"S-557", "sides 3x5, 257x511", "sizes taken for powers of two", "exact averages", kTested},
    {"S-558", "16384 texels a side", "32-bit offsets overflow", "the last texel is read", kTested},
    {"S-559", "a constant texture", "254 or 256", "the constant, by any filter", kTested},
    {"S-560", "random texels", "beyond their range", "within it, and monotone", kTested},
    {"S-561", "each address mode at its seam", "off by one", "the table", kTested},
    {"S-562", "anisotropy 1e6, 0", "a tap for every texel", "1 ... 16 taps", kTested},
    {"S-563", "the levels of a checker in sRGB", "dark: 128", "188", kTested},
    {"S-564", "NaN beside the footprint", "0 * NaN", "skipped", kTested},
    {"S-565", "a detail texture that faded to grey", "neutral detail changes the colour", "0.991834 for code 128, 0.983475 for 0.5, as documented", kTested},
    {"S-566", "no texture, or none of any size", "a null read", "white, grey, black, flat: exactly; sizes are errors", kTested},
    {"S-567", "levels built by several threads at once", "a race", "the same levels, complete", kTested},
    {"S-568", "directions exactly on edges and corners of a cube map, and one float aside", "a seam, or a texel of no face", "the same colour within 2/4096", kTested},
    {"S-569", "directions zero, NaN, infinite, subnormal, 3e38", "0/0, face -1", "a colour of the map; zero is +z", kTested},
    // --- normals ---
    {"S-601", "all 65536 pairs of codes of a two-channel normal", "NaN for 14496 of them", "z 0 there; unit within 2e-7", kTested},
    {"S-602", "the flat code (128,128)", "taken for flat", "tilted by 0.31776 degrees, as documented", kTested},
    {"S-603", "bump scale 0", "0 * infinity", "exactly flat", kTested},
    {"S-604", "bump scale 1e6, 1e30, -1, NaN, infinite", "overflow", "finite; x and y keep their direction within 1e-4 degrees", kTested},
    {"S-605", "bump scale of RGB normals", "not of unit length", "unit within 2e-7", kTested},
    {"S-606", "equal heights, one texel", "0/0", "exactly flat", kTested},
    {"S-607", "heights half a texel away", "point filtering ties: the last bit decides", "bilinear: it does not", kTested},
    {"S-608", "heights 1/512 texel apart", "0, or twice the slope: up to 45 degrees off", "within 2.9 degrees, one texel's error, down to 1/512", kTested},
    {"S-609", "an 8-bit staircase, 1/16 code per texel", "flat and steep in turn", "one code's slope; 16 bits within 1/256 of it", kTested},
    {"S-610", "the border of a height map", "another slope there", "as inside", kTested},
    {"S-611", "derivatives added, with z = 0", "infinity minus infinity", "the limit within 1e-3 degrees", kTested},
    {"S-612", "RNM of a normal that points down", "NaN", "unit within 1e-3", kTested},
    {"S-613", "RNM of lengths 0.9 to 1.1", "wrong length and angle", "unit; within 6 degrees", kTested},
    {"S-614", "the average of opposite normals", "the zero vector", "the first one", kTested},
    {"S-615", "one of two maps flat", "the other is changed", "kept within 1e-4 degrees by whiteout, derivatives, RNM", kTested},
    {"S-616", "two maps in the other order", "another picture", "the same bits for average, derivatives, whiteout", kTested},
    {"S-617", "RGB normals with z < 0", "RNM's pole", "z 0", kTested},
    {"S-618", "a level of opposite normals", "normalize(0)", "flat", kTested},
    {"S-619", "vectors of length 1e-30 to 1e30", "their square is 0 or infinite", "direction within 1e-5 degrees", kTested},
    {"S-620", "each face of a cube, uv mirrored or not", "axes mixed up", "x leans to +T, y to +B", kTested},
    // --- tangent frames ---
    {"S-651", "tangents of no direction, parallel to the normal, NaN", "no binormal", "a perpendicular unit vector", kTested},
    {"S-652", "tangents 1e-4 and 1e-6 radians from the normal", "noise is amplified", "|T.N| at most 1e-6", kTested},
    {"S-653", "tangent.w 0, 0.5, interpolated", "the binormal shrinks", "its sign alone counts", kTested},
    {"S-654", "triangles without area in uv", "infinite tangents", "a unit vector, perpendicular to the normal", kTested},
    {"S-655", "cotangent frame of constant uv", "0 * infinity: black dots", "the normal, to the bit", kTested},
    {"S-656", "the picture upside down", "T and B turn around", "the same within 1e-4 degrees", kTested},
    {"S-657", "a quad over the silhouette", "derivatives of another surface", "those of its triangle, within 0.1 degrees", kTested},
    {"S-658", "frames by cross products along the axes", "NaN", "the picture of the swizzle within 1e-5", kTested},
    {"S-659", "the poles of spheres of 3 to 1024 segments", "a ring of NaN", "finite", kTested},
    {"S-660", "decoding by MikkTSpace's rules", "made unit length in between", "the sum within 1e-5 degrees", kTested},
    {"S-661", "edges that bend by almost half a turn", "a normal near 0", "finite", kTested},
    // --- triplanar ---
    {"S-701", "normals zero and NaN", "0/0", "the ground plane: (0,1,0)", kTested},
    {"S-702", "the corner, offsets up to 1", "0/0 beyond 0.57735", "a third each", kTested},
    {"S-703", "all directions, all weights", "the sum drifts", "1 within 3 * 2^-24", kTested},
    {"S-704", "powers 64, 128", "underflow", "sum 1, the largest at least 1/3", kTested},
    {"S-705", "a component of +-0", "sign(0) = 0 removes z", "sign 1; no jump", kTested},
    {"S-706", "negative components", "pow is NaN", "the same weights on both sides", kTested},
    {"S-707", "clamp of NaN", "std::clamp keeps it", "the lower limit", kTested},
    {"S-708", "asymmetric weights on the axes", "normalize(0)", "exactly that plane", kTested},
    {"S-709", "height blend of equal, huge heights, range 0", "0/0", "sum 1", kTested},
    {"S-710", "a wall along an axis", "methods differ", "all but UDN give the map's normal within 1e-5 degrees", kTested},
    {"S-711", "GPU Gems 3 beside UDN", "taken for two methods", "one, within 1e-5 degrees", kTested},
    {"S-712", "1e6 units from the origin", "texels jump", "within 1e-3 texel with whole tiles taken off", kTested},
    {"S-713", "mirrored sides", "bumps inverted there", "each lit as a real bump", kTested},
    // --- light ---
    {"S-801", "a light on the surface", "1/0", "finite; at most 1000 times its strength", kTested},
    {"S-802", "light without direction", "NaN", "dark", kTested},
    {"S-803", "light that sinks below the surface", "a jump as high as the highlight", "no jump with N.L; the tutorial's form shows it", kTested},
    {"S-804", "exponents to 1e30, a base of 1 + ulp", "overflow", "at most 1; off by 3.4e-3 at 1e4", kTested},
    {"S-805", "0 to the power of 0", "NaN", "1", kTested},
    {"S-806", "a negative base", "NaN", "0", kTested},
    {"S-807", "GGX at smoothness 1", "the epsilon leaves 0.00016 of the peak", "exact form: the peak within 4e-6, around it within 1e-5 of double", kTested},
    {"S-808", "light opposite to the viewer", "no half vector: NaN", "finite", kTested},
    {"S-809", "N.V = 0, N.L = 0", "0/0", "finite, not negative", kTested},
    {"S-810", "white furnace, GGX", "gain", "at most 1.001", kTested},
    {"S-811", "white furnace, Disney's diffuse", "taken for energy preserving", "at most 1.56, as documented", kTested},
    {"S-812", "smoothness -1, 2, NaN", "nonsense", "as clamped, to the bit", kTested},
    {"S-813", "rim light, powers 0 to 1e6", "pow(0, 0)", "0 ... 1", kTested},
    {"S-814", "reflection at normals of length 0.9 to 1.1", "brighter than the light", "at most 1 + 2^-22", kTested},
    {"S-815", "a constant environment", "normals change it", "constant within 1e-6", kTested},
    {"S-816", "2, 16, 256 passes", "rounding adds up", "K * 2^-24 in float, K/2 codes in 8 bits", kTested},
    {"S-817", "a light per vertex at its range", "1/26 is left: it pops", "1 code with the window", kTested},
    {"S-818", "a spot from behind", "a mirrored cone", "0", kTested},
    {"S-819", "a bump that faces the light on a face that does not", "light leaks", "0 with a test of the geometric normal", "no lighting function tests the geometric normal; a program can, with ddx and ddy of the position"},
    {"S-820", "light per vertex", "the highlight is missing", "closer with every subdivision", kTested},
    // --- depth ---
    {"S-901", "the same triangles twice", "speckles where depths differ", "less: 0 pixels; equal: all", kTested},
    {"S-902", "two planes one behind the other", "the wrong one in front", "right from 4 steps of depth on", kTested},
    {"S-903", "reversed depth, the far plane at infinity", "clear value and comparison not turned", "right from 4 steps of depth on", kTested},
    {"S-904", "near 1e-3, far 1e6", "depth runs out", "finite, and right from 4 steps on", kTested},
    {"S-905", "depth bounds of a block", "visible pixels rejected", "as pixel by pixel, to the bit", kTested},
    {"S-906", "a NaN depth from a program", "written by `always`", "dropped and counted; the cleared depth stays", kTested},
    {"S-907", "depth bias of an edge-on triangle", "0 * infinity", "skipped when its factor is 0", kTested},
    {"S-908", "depth in 16 or 24 bits", "truncated", "nearest", "depth is a 32-bit float: nothing is converted"},
    {"S-909", "depth 1 ulp beyond 0 and 1, not clipped", "wraps to 0", "0 or 1", kTested},
    {"S-910", "discard before the depth test", "hidden by a pixel that is not there", "as the late test, to the bit", kTested},
    // --- parallax and shadows ---
    {"S-921", "parallax along the horizon, from below, by directions that are none", "an offset that is infinite or NaN", "finite; 0 from below; a march ends after its steps", kTested},
    {"S-922", "parallax with 0, 1e38, NaN steps; heights NaN, infinite, below 0", "a march without an end", "finite; ends after at most 1024 steps", kTested},
    {"S-923", "5.10 to 5.15 from the surface's own height, just above and below it", "NaN in the picture", "finite; nothing is drawn from below", kTested},
    {"S-924", "light 60 to 0.1 degrees above a floor alone", "stripes", "no point dark: by slope at any angle, or along the normal", kTested},
    {"S-925", "points beside a shadow map, behind its far plane, NaN; no map", "a texel of the other side", "lit beside it; 0 to 1 for any numbers", kTested},
    // --- framebuffer ---
    {"S-951", "colours NaN, infinite, -0, 1e30, subnormal", "255, or garbage", "NaN to 0; clamped to the format", kTested},
    {"S-952", "around every half code", "rounded twice", "nearest, ties up; 256 codes", kTested},
    {"S-953", "sRGB of 2^24 floats", "steps back", "never falls; within 0.51 of a code", kTested},
    {"S-954", "255 + 255", "254", "255", kTested},
    {"S-955", "16 passes in 8 bits", "drift", "K/2 codes", kTested},
    {"S-956", "rows that are no multiple of a block, 1 px", "the last store of a row overwrites the next", "nothing outside of the rectangle changes", kTested},
    {"S-957", "a part of a tile cleared or stored", "the neighbour is touched", "its rectangle alone", kTested},
    {"S-958", "16-bit float targets", "infinite at 7e4", "65504", kTested},
    {"S-959", "NaN in the target before blending", "it stays and spreads", "0 wherever something is drawn; the rest is the owner's", kTested},
    {"S-960", "helper lanes, discarded lanes", "written", "never", kTested},
    // --- threads, processors, builds ---
    {"S-1001", "threads by tile sizes by scenes", "the order decides", "the same bits", kTested},
    {"S-1002", "1000 triangles blended over one another", "bins out of order", "as drawn one by one, to the bit", kTested},
    {"S-1003", "a hundred repetitions", "now and then another", "one hash", kTested},
    {"S-1004", "all triangles in one tile, one over all", "bins overflow", "complete", kTested},
    {"S-1005", "more threads than tiles, no draws", "a dead-lock", "returns within a second", kTested},
    {"S-1006", "a target that cannot be had", "a crash, or half a frame", "an error; the next frame is the same", kTested},
    {"S-1007", "the same under the thread sanitizer", "a race", "no report (preset tsan)", kTested},
    {"S-1008", "the caller's rounding mode, flushing of subnormals", "results differ by thread", "the same bits; the mode is given back", kTested},
    {"S-1009", "4, 8, 16 lanes; SSE2, AVX2, AVX-512", "another picture", "one hash, in the source", kTested},
    {"S-1010", "compilers, optimisation, contraction", "fused operations move edges", "one hash, in the source", kTested},
    {"S-1011", "another maker's processor", "estimates of 1/x differ", "no estimate is used: one hash, in the source", kTested},
    {"S-1012", "everything subnormal", "a hundred times slower, or flushed", "the right bits; the time is reported", kTested},
    {"S-1013", "frames thrown away, targets of another size and freed in between", "a dangling tile", "the same picture (preset asan)", kTested},
    // --- what is left out ---
    {"S-1101", "every pair of features, needed and not", "the special case differs", "the same bits as with the feature on and neutral", kTested},
    {"S-1102", "no normal map", "tangents are read all the same", "0 fetches, 0 components", kTested},
    {"S-1103", "triplanar, a mesh without uv", "uv are made or read", "none; the same picture with garbage for uv", kTested},
    {"S-1104", "planes of weight 0", "sampled all the same", "1 plane on a wall; the same bits as all three", kTested},
    {"S-1105", "no detail map beside a flat one of 8 bits", "taken for equal", "0.31776 degrees apart; above 0 and at most 1.41439 codes of Lambert", kTested},
    {"S-1106", "opaque draws, depth alone", "colour, attributes, blending paid for", "0 pixels shaded behind, 0 components", kTested},
    {"S-1107", "one light", "passes for lights that are not there", "1 draw; the picture of the lights turned to 0", kTested},
};
// clang-format on

// --- collecting ---

struct Number
{
    std::string what;
    double value;
    std::optional<double> bound;
};

std::vector<Number>& numbers()
{
    static std::vector<Number> all;
    return all;
}

// Of the numbers with the same name the one that is worst stays.
void note(const std::string& what, double value, std::optional<double> bound)
{
    for (Number& n : numbers()) {
        if (n.what != what || n.bound != bound) continue;
        if (!(value <= n.value)) n.value = value;
        return;
    }
    numbers().push_back({what, value, bound});
}

// JSON has no infinities.
nlohmann::json toJson(double value)
{
    if (std::isfinite(value)) return value;
    return std::isnan(value) ? "NaN" : value > 0.0 ? "infinite" : "-infinite";
}

// Writes what the tests measured into the file that the environment names, if it does.
class Listener : public doctest::IReporter
{
public:
    explicit Listener(const doctest::ContextOptions&)
    {
        if (const char* file = std::getenv("RELIEF_STABILITY_FILE")) path = file;
    }

    void test_case_start(const doctest::TestCaseData& data) override
    {
        name = data.m_name;
        numbers().clear();
    }

    void test_case_end(const doctest::CurrentTestCaseStats& stats) override
    {
        if (path.empty()) return;
        nlohmann::json test = {{"name", name},
                               {"ids", idsIn(name)},
                               {"checks", stats.numAssertsCurrentTest},
                               {"failed", stats.numAssertsFailedCurrentTest},
                               {"passed", stats.testCaseSuccess},
                               {"seconds", stats.seconds},
                               {"numbers", nlohmann::json::array()}};
        for (const Number& n : numbers()) {
            test["numbers"].push_back({{"what", n.what}, {"value", toJson(n.value)}});
            if (n.bound) test["numbers"].back()["bound"] = toJson(*n.bound);
        }
        tests.push_back(std::move(test));
    }

    void test_run_end(const doctest::TestRunStats&) override
    {
        if (path.empty()) return;
        nlohmann::json table = nlohmann::json::array();
        for (const Case& c : cases()) {
            table.push_back({{"id", c.id}, {"input", c.input}, {"naive", c.naive}, {"bound", c.bound}});
            if (c.missing != nullptr) table.back()["missing"] = c.missing;
        }
        std::ofstream(path) << nlohmann::json{{"cases", table}, {"tests", tests}}.dump(1) << '\n';
    }

    void report_query(const doctest::QueryData&) override {}
    void test_run_start() override {}
    void test_case_reenter(const doctest::TestCaseData&) override {}
    void test_case_exception(const doctest::TestCaseException&) override {}
    void subcase_start(const doctest::SubcaseSignature&) override {}
    void subcase_end() override {}
    void log_assert(const doctest::AssertData&) override {}
    void log_message(const doctest::MessageData&) override {}
    void test_case_skipped(const doctest::TestCaseData&) override {}

private:
    std::string path, name;
    nlohmann::json tests = nlohmann::json::array();
};

REGISTER_LISTENER("stability", 1, Listener);

}  // namespace

std::span<const Case> cases()
{
    return kCases;
}

std::vector<std::string> idsIn(const std::string& testName)
{
    std::vector<std::string> ids;
    const Pattern id(R"(\bS-[0-9]+)");
    for (const Match& m : id.find(testName)) {
        ids.push_back(m[0]);
    }
    return ids;
}

int trials(int small, int full)
{
#if defined(RELIEF_SHORT_TESTS)
    constexpr bool isShort = true;
#else
    constexpr bool isShort = false;
#endif
    static const bool isFull = std::getenv("RELIEF_FULL_TRIALS") != nullptr;
    if (isFull) return full > 0 ? full : 10 * small;
    return isShort ? std::max(1, small / 10) : small;
}

void noted(const char* what, double value)
{
    note(what, value, std::nullopt);
}

void detail::check(const char* what, double value, double bound, const char* file, int line)
{
    note(what, value, bound);
    if (value <= bound) {
        CHECK(value <= bound);
    } else {
        const std::string message = what + std::string(" is too large");
        ADD_FAIL_CHECK_AT(file, line, message << ": " << value << ", at most " << bound);
    }
}

}  // namespace stability

TEST_CASE("stability: every case of the table has a test or says what does not exist, and tests name no other")
{
    std::map<std::string, int> testsOf;
    const Pattern test(R"re(TEST_CASE\(\s*((?:"[^"]*"\s*)+)\))re");
    for (const auto& entry : std::filesystem::directory_iterator(RELIEF_SOURCE_FOLDER "/tests")) {
        if (entry.path().extension() != ".cpp") continue;
        const std::string source = contents(entry.path());
        for (const Match& m : test.find(source)) {
            for (const std::string& id : stability::idsIn(m[1])) ++testsOf[id];
        }
    }
    std::set<std::string> known;
    for (const stability::Case& c : stability::cases()) {
        CAPTURE(c.id);
        CHECK(known.insert(c.id).second);
        CHECK((testsOf[c.id] > 0) == (c.missing == nullptr));
    }
    for (const auto& tested : testsOf) {
        CAPTURE(tested.first);
        CHECK((known.count(tested.first) == 1 || tested.second == 0));
    }
    CHECK(known.size() == 201);
}

TEST_CASE("stability: ids are found in names")
{
    CHECK(stability::idsIn("clip: two (S-202, S-1006)") == std::vector<std::string>{"S-202", "S-1006"});
    CHECK(stability::idsIn("XS-1 T-05 plain").empty());
}

TEST_CASE("stability: a number above its bound fails, and so does one that is none" * doctest::expected_failures(2))
{
    stability::measured("at its bound", 1, 1);
    stability::measured("above", 2, 1);
    stability::measured("NaN", std::nan(""), 1);
}
