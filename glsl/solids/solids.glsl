// Rays against solids, exactly: where a ray meets each, and which of two hits is the nearer.
#include "ray.glsl"
#include "close_up.glsl"
#include "sphere.glsl"
#include "box.glsl"
#include "axis.glsl"
#include "cylinder.glsl"
#include "cone.glsl"
#include "nearest.glsl"
