// What a path goes on by from a surface: one ray, diffuse, mirrored or refracted, chosen by what each may weigh.

// Decisions, two for each generation after the first.
const uint PLACE_IN_PIXEL = 0u;
uint choice_of(uint generation) { return 2u * generation; }
uint direction_of(uint generation) { return 2u * generation + 1u; }

// A decision more of each generation; the others are far fewer.
uint light_of(uint generation) { return 0x80000000u + generation; }

// Below this weight Russian roulette ends paths; docs/path-tracing.md has the figures that chose it.
const Real ROULETTE_WEIGHT = 0.25;

// Of the two numbers of the choice, that which chooses the successor; the other is the roulette's.
Real chosen;

// What the diffuse, the mirrored and the refracted ray may weigh, by their brightest channel.
Real3 possible_weights(Path path, Material material, Real reflection, Real transmission) {
    Real most = largest_component(path.weight);
    Real diffuse = largest_component(path.weight * (material.diffuse * material.color));
    return Real3(diffuse, most * reflection, most * transmission);
}

// On from the nearest hit, by the number that was drawn at its end.
void go_on(inout Path path) {
    Material material = nearest_material(path);
    Hit hit = path.nearest;
    Real reflection = material.reflection, transmission = 0.0;
    Real3 through = path.incident;
    bool is_inside = hit.inside;
    Real medium = path.medium;
    if (MEDIA != NO_MEDIA) {
        transmission = material.transmission;
        is_inside = false;
        if (material.refractive_index > 0.0 && transmission > 0.0) {
            Real here = hit.inside ? material.refractive_index : path.medium;
            medium = hit.inside ? path.medium_outside : material.refractive_index;
            is_inside = !hit.inside;
            if (!refracted(path.incident, hit.normal, here, medium, through)) {
                reflection += transmission;
                transmission = 0.0;
            }
        }
    }
    Real3 weights = possible_weights(path, material, reflection, transmission);
    Real all = weights.x + weights.y + weights.z;
    Real place = chosen * all;
    // What weighs nothing is not chosen where a sum was rounded, either.
    bool is_diffuse = place < weights.x || weights.y + weights.z == 0.0;
    bool is_mirrored = !is_diffuse && (place < weights.x + weights.y || weights.z == 0.0);
    Real3 direction;
    if (is_diffuse) {
        direction = diffuse_direction(hit.normal, pair(direction_of(path.generation)));
        path.weight *= (material.diffuse * material.color) * (all / weights.x);
    } else {
        direction = is_mirrored ? unit(mirrored(path.incident, hit.normal)) : through;
        path.weight *= is_mirrored ? reflection * (all / weights.y) : transmission * (all / weights.z);
    }
    bool goes_through = !is_diffuse && !is_mirrored;
    if (MEDIA != NO_MEDIA && goes_through) path.medium = medium;
    path.ray = Ray(hit.point, Real3(0.0), direction);
    path.origin_surface = OriginSurface(hit.slot, hit.face, MEDIA != NO_MEDIA && goes_through ? is_inside : hit.inside);
    path.purpose = TO_NEAREST;
}

Real choice_of_light(Path path) { return pair(light_of(path.generation)).x; }

// All light that comes from everywhere comes by paths.
Real3 ambient_radiance(Material material) { return Real3(0.0); }

void end_generation(inout Path path) {
    Material material = nearest_material(path);
    path.color = limited(path.color + path.weight * path.local_radiance);
    path.generation++;
    Real transmission = MEDIA != NO_MEDIA ? material.transmission : Real(0.0);
    Real3 weights = possible_weights(path, material, material.reflection, transmission);
    Real all = weights.x + weights.y + weights.z;
    bool goes_further = HAS_REFLECTIONS && path.is_hit && all > 0.0 && path.generation < frame.depth;
    if (goes_further) {
        Real2 numbers = pair(choice_of(path.generation));
        chosen = numbers.x;
        // What goes on stands for what does not.
        Real survival = min(all / ROULETTE_WEIGHT, Real(1.0));
        goes_further = numbers.y < survival;
        path.weight /= survival;
        // So that sums of weights stay numbers.
        path.weight = min(path.weight, Real3(0.125 * LARGEST));
    }
    path.purpose = goes_further ? ONWARD : ENDED;
    if (MEDIA == NESTED && goes_further && material.transmission > 0.0 && path.nearest.inside) {
        path.ray = Ray(path.nearest.point, Real3(0.0), path.incident);
        path.origin_surface = OriginSurface(path.nearest.slot, path.nearest.face, false);
        ask_for_medium(path);
    }
}
