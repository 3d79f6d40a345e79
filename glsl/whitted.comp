#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// The accurate kernel (docs/light-model.md, "The accurate model"; docs/numerics.md): one source for float and double.
layout(local_size_x_id = 5, local_size_y_id = 6) in;

#include "whitted/solids.glsl"
#include "whitted/search.glsl"
#include "whitted/shade.glsl"
#include "whitted/camera.glsl"
#include "whitted/light_spheres.glsl"
#include "whitted/picture.glsl"
#include "whitted/trace.glsl"

void main() { trace(view()); }
