// What the host writes and kernels of the accurate model read, and the numbers that it is in.
#include "common/packet.glsl"
#include "common/real.glsl"
#include "push_constants.glsl"
#include "scene.glsl"
