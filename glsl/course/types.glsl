// Types and constants that the listings use without showing them.
#define EPS 1e-7
#define INF 1e7
#define R_LSOURCE 0.01

struct Ray {
    vec3 origin;
    vec3 direction;
};

struct Intersection {
    float t;
    vec3 point;
    vec3 normal;
    Material material;
    Ray tracedRay;
};
