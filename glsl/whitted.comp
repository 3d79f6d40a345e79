#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// The accurate kernel (DESIGN.md, "The accurate model"; NUMERICS.md): one source for float and double.
layout(local_size_x_id = 5, local_size_y_id = 6) in;

#include "whitted/solids.glsl"
#include "whitted/search.glsl"
#include "whitted/shade.glsl"
#include "whitted/camera.glsl"
#include "whitted/balls.glsl"
#include "whitted/trace.glsl"

// One tile, row by row, linear RGB; alpha: samples that came to their end. A buffer and no image: a CPU driver takes three
// times as long to store into an image, invocation by invocation, which would be a sixth of a frame.
layout(binding = 0, std430) buffer Picture { vec4 picture[]; };

vec4 mean_before(uint place) { return picture[place]; }

void main() {
    Traced traced = trace(view());
    for (uint k = 0u;;) {
        uvec2 pixel = tile_pixel(k);
        bool is_ended = k + 1u < traced.begun || (k + 1u == traced.begun && turns < LOOP_TURNS);
        Real3 color = Real3(0.0);
#define CHOOSE_ONE(i) \
    if (i < PIXELS && k == i && i < traced.begun) color = traced.colors[i];
        EIGHT_TIMES(CHOOSE_ONE)
#undef CHOOSE_ONE
        vec3 shown = vec3(min(color, Real3(3.4028234663852886e38)));
        if (frame.writes_remainder != 0u) shown = vec3(min(color - Real3(shown), Real3(3.4028234663852886e38)));
        float ended = is_ended ? 1.0 : 0.0;
        if (is_there(pixel)) {
            uint place = pixel.y * unpacked(frame.tile_size).x + pixel.x;
            if (HAS_SAMPLES && frame.samples_before > 0u) {
                vec4 before = mean_before(place);
                precise vec3 mean = before.rgb + (shown - before.rgb) * frame.sample_weight;
                shown = mean;
                ended += before.a;
            }
            picture[place] = vec4(shown, ended);
        }
        k++;
        if (k == PIXELS) break;
    }
}
