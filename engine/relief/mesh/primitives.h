// The shapes that need no file: quad, grid, cube, two spheres and a terrain. All in object space, left-handed, Y up,
// front faces clockwise, uv (0,0) in the lower left corner, with unit normals and with tangents along +u (mesh.h). The
// same arguments give the same bits on every machine. Counts out of range are clamped, so that no shape takes more than
// 640 MB.
#pragma once

#include "relief/mesh/mesh.h"

namespace relief {

// Unity's quad: 1 x 1 in the XY plane, centred at the origin, looking along -Z at a camera in front of it.
Mesh makeQuad();

// The same quad in cellsX x cellsY cells of two triangles, for programs that move its vertices. Cells are clamped as in
// makeTerrain.
Mesh makeGrid(int cellsX, int cellsY);

// The unit cube, 24 vertices: every face shows the whole picture, upright on the four sides. Seen from the front (-Z),
// the top and the bottom are unfolded upwards and downwards from the front face.
Mesh makeCube();

// A sphere of radius 0.5, by longitude (u, the seam at +Z is doubled) and latitude (v, 0 at -Y). Each pole has one
// vertex per segment, in the middle of its u. Segments are clamped to 3..1024, rings to 2..1024.
Mesh makeSphere(int segments, int rings);

// A sphere of radius 0.5 made of the six faces of makeCube, each a grid of subdivisions x subdivisions cells whose
// points are pushed out to the sphere. Subdivisions are clamped to 1..1024.
Mesh makeCubeSphere(int subdivisions);

// Rolling hills over x, z in -0.5..0.5 with heights within +-0.1: (cellsX + 1) * (cellsZ + 1) vertices and two
// triangles per cell. The hills do not depend on the number of cells. Cells are clamped to 1..4096, and
// cellsZ further so that there are at most 2^23 of them.
Mesh makeTerrain(int cellsX, int cellsZ);

}  // namespace relief
