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

float dot_(vec3 a, vec3 b) { return a.z * b.z + a.y * b.y + a.x * b.x; }
#define dot dot_
vec3 normalize_(vec3 v) { return v * inversesqrt(dot(v, v)); }
#define normalize normalize_
vec3 reflect_(vec3 I, vec3 N) { return I - 2.0 * dot(N, I) * N; }
#define reflect reflect_
float length_(vec3 v) { return sqrt(dot(v, v)); }
#define length length_
// m·v; SPIR-V's own product adds the columns in the other order on lavapipe.
vec3 rotate(mat3 m, vec3 v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }
