// Where a path goes on from a surface: mirrored, refracted or both. Of both the heavier goes first and the other waits,
// so that no more wait than there are generations.

layout(constant_id = 25) const uint MOST_PENDING = 1u;

struct Pending {
    Real3 origin;
    Real3 direction;
    Real weight;
    Real medium;
    uint slot;   // whose surface it leaves
    uint packed; // face, whether it leaves to the inside, generation
};

const uint INSIDE_BIT = 4u;
const uint GENERATION_BIT = 5u;

Pending pending[MOST_PENDING];

struct Branch {
    Real3 direction;
    Real weight;
    Real medium;
    bool inside; // of the solid whose surface it leaves
};

void put_off(Branch branch, inout Path path) {
    uint packed = path.nearest.face | uint(branch.inside) << INSIDE_BIT | path.generation << GENERATION_BIT;
    pending[path.pending] =
        Pending(path.nearest.point, branch.direction, branch.weight, branch.medium, path.nearest.slot, packed);
    path.pending++;
}

void follow(Branch branch, inout Path path) {
    path.ray = Ray(path.nearest.point, Real3(0.0), branch.direction);
    path.weight = branch.weight;
    path.medium = branch.medium;
    path.origin_surface = OriginSurface(path.nearest.slot, path.nearest.face, branch.inside);
    path.purpose = TO_NEAREST;
}

void resume(inout Path path) {
    path.pending--;
    Pending next = pending[path.pending];
    path.ray = Ray(next.origin, Real3(0.0), next.direction);
    path.weight = next.weight;
    path.medium = next.medium;
    uint face = bitfieldExtract(next.packed, 0, int(INSIDE_BIT));
    bool is_inside = bitfieldExtract(next.packed, int(INSIDE_BIT), 1) != 0u;
    path.origin_surface = OriginSurface(next.slot, face, is_inside);
    path.generation = next.packed >> GENERATION_BIT;
    path.purpose = TO_NEAREST;
}

// On from the nearest hit. Where all is reflected, the mirrored ray gets the refracted one's weight, too.
void branch(inout Path path) {
    Material material = nearest_material(path);
    Hit hit = path.nearest;
    Branch mirror = Branch(unit(mirrored(path.incident, hit.normal)), path.weight * material.reflection, path.medium,
                           hit.inside);
    Branch through = Branch(path.incident, path.weight * material.transmission, path.medium, false);
    // A plate is left on the other side, which is outside of it, too.
    if (material.refractive_index > 0.0 && material.transmission > 0.0) {
        Real here = hit.inside ? material.refractive_index : path.medium;
        through.medium = hit.inside ? path.medium_outside : material.refractive_index;
        through.inside = !hit.inside;
        if (!refracted(path.incident, hit.normal, here, through.medium, through.direction)) {
            // Of coefficients above 1 together, a weight may grow beyond all numbers.
            mirror.weight = min(mirror.weight + through.weight, LARGEST);
            through.weight = 0.0;
        }
    }
    bool has_mirror = mirror.weight > Real(frame.min_throughput), has_through = through.weight > Real(frame.min_throughput);
    bool goes_through_first = has_through && !(has_mirror && mirror.weight >= through.weight);
    if (has_mirror && has_through) {
        if (goes_through_first) put_off(mirror, path);
        else put_off(through, path);
    }
    if (goes_through_first) follow(through, path);
    else if (has_mirror) follow(mirror, path);
    else if (path.pending > 0u) resume(path);
    else path.purpose = ENDED;
}
