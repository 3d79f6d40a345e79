#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// The accurate kernel (docs/light-model.md, docs/numerics.md): one source for float and double.
layout(local_size_x_id = 5, local_size_y_id = 6) in;

#include "records/records.glsl"
#include "solids/solids.glsl"
#include "search/search.glsl"
#include "camera/camera.glsl"
#include "camera/picture.glsl"
#define Weight Real
#include "transport/transport.glsl"

void put(uint index, Path path, bool is_ended) { put(index, path.color, is_ended ? 1.0 : 0.0); }

#include "whitted/trace.glsl"

void main() { trace(); }
