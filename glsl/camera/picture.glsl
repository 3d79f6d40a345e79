// Where pixels go.

// One tile, row by row, linear RGB; alpha: samples that came to their end. A buffer and no image: a CPU driver takes
// three times as long to store into an image, invocation by invocation, which would be a sixth of a frame.
layout(binding = 0, std430) buffer Picture { vec4 picture[]; };

vec4 mean_before(uint place) { return picture[place]; }

// The mean colour of a run's samples, one or several, of the invocation's pixel with this index, and how many of them
// came to their end; of one that has not, what there is.
void put(uint index, Real3 color, float ended) {
    uvec2 pixel = tile_pixel(index);
    vec3 shown = vec3(min(color, Real3(3.4028234663852886e38)));
    if (frame.writes_remainder != 0u) shown = vec3(min(color - Real3(shown), Real3(3.4028234663852886e38)));
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
}
