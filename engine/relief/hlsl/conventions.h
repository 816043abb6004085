// The conventions of the engine, stated once: Unity's and Direct3D's.
//
//   world            left-handed, Y up
//   vectors          columns: clipFromObject = clipFromWorld * worldFromObject; matrices are named targetFromSource
//   clip space       0 <= z <= w (near at 0, or at w when depth is reversed), -w <= x, y <= w, y up
//   image            row 0 on top; pixel centres at .5; SV_POSITION.xy counts pixels from the upper left corner
//   front face       clockwise on screen
//   uv               (0, 0) is the lower left corner of the picture
//   cube map         faces +x, -x, +y, -y, +z, -z, turned as Direct3D has them: texture/cube_face.h
//   normal map       +Y: green is up, along +v
//   tangent.w        -1 or +1; binormal = cross(normal, tangent.xyz) * tangent.w * unity_WorldTransformParams.w
//   lighting         in linear colour: albedo textures are decoded from sRGB, heights and normals never are
#pragma once
