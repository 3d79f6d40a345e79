#version 460
// Every number but the first grows by its left neighbour: a dispatch takes a row of Pascal's triangle to the next one,
// so a dispatch that does not see all of the one before shows in the result.
layout(local_size_x = 64) in;
layout(binding = 0, std430) buffer Numbers { uint numbers[]; };

void main() {
    uint i = gl_LocalInvocationIndex;
    uint left = i > 0u ? numbers[i - 1u] : 0u;
    // One workgroup alone: all have read before one writes.
    barrier();
    numbers[i] += left;
}
