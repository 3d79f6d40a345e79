#version 460
#extension GL_GOOGLE_include_directive : require
// The random numbers of path tracing, and the directions about a normal that they give: of one pixel and one decision, a
// sample an invocation.
layout(local_size_x = 64) in;

#include "common/real.glsl"
#include "path/numbers.glsl"
#include "path/diffuse.glsl"

struct Question {
    Real4 normal; // unit; the last is not read
    uint seed;    // of the pixel
    uint decision;
};

struct Answer {
    Real4 numbers; // the last two are not written
    Real4 direction;
};

layout(binding = 0, std430) readonly buffer Questions { Question question; };
layout(binding = 1, std430) buffer Answers { Answer answers[]; };

void main() {
    sequence = Sequence(question.seed, gl_GlobalInvocationID.x);
    Real2 numbers = pair(question.decision);
    Real3 direction = diffuse_direction(question.normal.xyz, numbers);
    answers[gl_GlobalInvocationID.x] = Answer(Real4(numbers, 0.0, 0.0), Real4(direction, 0.0));
}
