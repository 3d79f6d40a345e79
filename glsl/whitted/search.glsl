// Included once for each kind, with SOLIDS the array of its records. The solids are counted within the kind; the first
// of them has the slot `first_slot`.

void NEAREST(Ray ray, Departure departure, uint begin, uint end, uint first_slot, inout Hit nearest) {
    for (uint chunk = begin; chunk < end && turns < LOOP_TURNS; chunk += 32u) {
        turns += CHUNK_TURNS;
        Real limit = nearest.slot == NOTHING ? LARGEST : nearest.t;
        uint left = candidates(ray, departure, first_slot + chunk, min(32u, end - chunk), limit);
        while (left != 0u) {
            uint index = chunk + uint(findLSB(left));
            left &= left - 1u;
            turns++;
            uint slot = first_slot + index;
            Hit hit;
            bool is_met = meet(SOLIDS[index], ray, origin_of(departure, slot), departure.face, hit);
            hit.slot = slot;
            if (is_met && is_nearer(hit, nearest, ray)) nearest = hit;
        }
    }
}

bool HIDES(Ray ray, Departure departure, Real3 target, Real distance, uint begin, uint end, uint first_slot) {
    bool hidden = false;
    for (uint chunk = begin; chunk < end && !hidden && turns < LOOP_TURNS; chunk += 32u) {
        turns += CHUNK_TURNS;
        uint left = candidates(ray, departure, first_slot + chunk, min(32u, end - chunk), distance);
        while (left != 0u && !hidden) {
            uint index = chunk + uint(findLSB(left));
            left &= left - 1u;
            turns++;
            Hit hit;
            bool is_met = meet(SOLIDS[index], ray, origin_of(departure, first_slot + index), departure.face, hit);
            hidden = is_met && is_before(hit, ray, target, distance, size(SOLIDS[index]));
        }
    }
    return hidden;
}
