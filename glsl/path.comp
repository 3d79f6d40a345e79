#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// Path tracing of the accurate model (docs/path-tracing.md): one source for float and double.
layout(local_size_x_id = 5, local_size_y_id = 6) in;

#include "records/records.glsl"
#include "solids/solids.glsl"
#include "search/search.glsl"
#include "camera/camera.glsl"
#include "camera/picture.glsl"
#define Weight Real3
#include "transport/transport.glsl"
#include "path/trace.glsl"

void main() { trace_samples(); }
