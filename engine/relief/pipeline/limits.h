// Every size constant of the pipeline, with the reason for its value.
#pragma once

#include <cstdint>

namespace relief {

// Vertices snap to 1/256 of a pixel: D3D's and llvmpipe's fixed point (D3D 11.3, 3.4.1).
inline constexpr int kSubpixelBits = 8;
inline constexpr int kSubpixels = 1 << kSubpixelBits;

// The largest side of a render target and of a viewport, in pixels: D3D's.
inline constexpr int kMaxTargetSize = 16384;

// Snapped coordinates stay within +-32767 px, so a difference of two of them stays below 2^24 sub-pixels: exact in a
// float, its products below 2^48 and an edge function below 2^49, exact in 64-bit integers and in doubles.
inline constexpr int kGuardBand = 32767;

// Clipping cuts at this w instead of at 0, so that 1/w is an ordinary number. Nothing visible is that near: at a depth
// range of 1e-6 .. 1e6 it would be 1e-24 of the near distance.
inline constexpr float kSmallestW = 1e-30f;

// Within a square of 64 px an edge function that changes sign there stays below 63 * (2^24 + 2^24) < 2^31: 32-bit
// integers hold it. Larger tiles are covered square by square.
inline constexpr int kCoverageSquare = 64;

// Triangles up to this extent have edge functions below 2^31 at every pixel of every block they touch:
// 2 * (96 * 256) * ((96 + 4) * 256) = 1.26e9.
inline constexpr int kSmallTriangle = 96;

// One tile's colour and depth together are 32 KiB at 64x64 and stay in a core's first-level cache.
inline constexpr int kDefaultTileSize = 64;
inline constexpr int kMaxTileSize = 128;

// Front-end work is handed out in pieces of this many vertices and triangles: small enough to share between threads,
// large enough that a piece costs far more than fetching the next one (about 0.1 us).
inline constexpr std::uint32_t kVerticesPerChunk = 2048;
inline constexpr std::uint32_t kTrianglesPerChunk = 4096;

// Pairs of a triangle and a tile that a frame keeps at a time, 12 bytes each: 48 MiB. A frame with more is run in
// parts, one after the other, with the same result. They are counted after every so many primitives, so each thread may
// go beyond the limit by as many times the number of tiles.
inline constexpr std::uint32_t kMaxBinned = 1u << 22;
inline constexpr std::uint32_t kPrimitivesPerCount = 256;

// Threads that a frame runs on.
inline constexpr int kMaxThreads = 256;

// Colour attachments of a target that a draw can write, and planes that a vertex program can clip at.
inline constexpr int kMaxColors = 4;
inline constexpr int kMaxClipDistances = 8;

// The interpolated components (floats) of one vertex: D3D's 32 registers of four.
inline constexpr int kMaxComponents = 128;

}  // namespace relief
