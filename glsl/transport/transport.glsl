// What algorithms that trace paths share. Weight: the type of a path's weight, one number or one for each channel.
#include "shade.glsl"
#include "light_spheres.glsl"
#include "path.glsl"
#include "steps.glsl"
