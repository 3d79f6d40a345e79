#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// Screen-space reflections, first pass: the accurate kernel's first generation, with what its rays met besides the light.
layout(local_size_x_id = 5, local_size_y_id = 6) in;

#include "records/records.glsl"
#include "solids/solids.glsl"
#include "search/search.glsl"
#include "camera/camera.glsl"
#define Weight Real
#define KEEPS_LIT true
#include "transport/transport.glsl"
#define ACCESS writeonly
#define RADIANCES 0
#include "ssr/surfaces.glsl"

// The surface that the invocation's pixel with this index shows, and its light.
void put(uint index, Path path, bool is_ended) {
    uvec2 pixel = tile_pixel(index);
    if (is_there(pixel)) {
        uint place = place_of(pixel);
        View camera = view_at_hand();
        bool is_solid = is_ended && path.is_hit;
        float reflection = is_solid ? nearest_material(path).reflection : 0.0;
        float ahead = dot(path.nearest.point - camera.position, camera.ahead);
        float nearness = is_solid && ahead > 0.0 ? 1.0 / ahead : 0.0;
        Side side = Side(path.nearest.face, path.nearest.inside, path.lit);
        radiances[place] = vec4(path.color, is_ended ? reflection : UNFINISHED);
        points[place] = vec4(path.nearest.point, 0.0);
        normals[place] = uvec4(floatBitsToUint(path.nearest.normal), packed(side));
        depths[place] = uvec2(floatBitsToUint(nearness), is_solid ? path.nearest.slot : NOTHING);
    }
}

#include "whitted/trace.glsl"

void main() { trace(); }
