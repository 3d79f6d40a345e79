// The course kernel's resources. Uniform buffers, since a loop over them is the fastest of all on lavapipe.
layout(push_constant, std430) uniform Push { Frame frame; };
layout(binding = 0, rgba32f) uniform writeonly image2D picture; // one tile, linear RGB
layout(binding = 1, std140) uniform Spheres { Sphere spheres[MAX_PRIMITIVES]; };
layout(binding = 2, std140) uniform Boxes { Box boxes[MAX_PRIMITIVES]; };
layout(binding = 3, std140) uniform Cylinders { Cylinder cylinders[MAX_PRIMITIVES]; };
layout(binding = 4, std140) uniform Cones { Cone cones[MAX_PRIMITIVES]; };

#define lightSource frame.light
