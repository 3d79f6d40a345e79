// Eight rays searched together, where invocations can hand each other numbers at the price of one instruction: each
// fetches one row of eight, and what any of the rays needs all of them look at. Elsewhere every ray is for itself.
//
// PACKETS: subgroups of eight invocations, all of them there. Whatever decides which way a loop goes must then be the
// same for all eight.

#if PACKETS
#extension GL_KHR_shader_subgroup_shuffle : require
const bool IN_PACKETS = true;

uint bits_of_packet(uint mine) {
    uint all = mine;
    all |= subgroupShuffleXor(all, 1u);
    all |= subgroupShuffleXor(all, 2u);
    return all | subgroupShuffleXor(all, 4u);
}

bool any_of_packet(bool mine) { return bits_of_packet(uint(mine)) != 0u; }
vec3 of_packet(vec3 mine, uint k) { return subgroupShuffle(mine, k); }
vec4 of_packet(vec4 mine, uint k) { return subgroupShuffle(mine, k); }

// Row `first + stride * k`, k < 8: this invocation has fetched the one whose k is its own number.
#define OWN_ROW(rows, first, stride) texelFetch(rows, int((first) + (stride) * gl_SubgroupInvocationID))
#else
const bool IN_PACKETS = false;
bool any_of_packet(bool mine) { return mine; }
uint bits_of_packet(uint mine) { return mine; }
#endif

#define EIGHT_TIMES(WORK) WORK(0u) WORK(1u) WORK(2u) WORK(3u) WORK(4u) WORK(5u) WORK(6u) WORK(7u)

// Loops are left at the end of their body: a CPU driver goes through a body until it has let every invocation go, and
// through all of it once more for nobody where they go at its head.
