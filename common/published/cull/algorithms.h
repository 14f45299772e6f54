#pragma once
#include "common/published/cull/member.h"
#include "common/published/cull/published_walk.h"

// Each algorithm over both kinds of tree. Instantiated for StoredTree and ComputedTree.
namespace swath {

// Adaptive delayed static balancing (ADSB, sections 3 to 6 and appendix A): the main processor walks breadth
// first until it has tested n = (8^(d + 1) - 1) / 7 nodes, then deals out what it has not. n is a budget of
// nodes, as printed, not a level: in a pruned tree it reaches far deeper than d. Of N nodes that are left
// every other processor gets N / p, rounded down, and the main processor keeps the rest. Mended:
// - figure 1: the budget is asked about only if there is one (printed, n = 0 stops after the first node);
// - the node list is a ring, not a list whose first element is erased;
// - the end of the main processor's work is its end time (printed, it is its start time a second time).
template <class Tree>
std::unique_ptr<PublishedWalk> make_adsb(const Tree& tree, ThreadTeam& team);

// Adaptive two-step static balancing (A2SSB, section 3.7, algorithm 5), as `algorithm` kAlgo1 to kAlgo3 or
// kAlgo1Lanes.
// Mended:
// - of N nodes, processor k of p gets those from N k / p to N (k + 1) / p (printed, N mod p are lost);
// - loops end before the size of their list, not at it;
// - every processor has a list of its own in step one, read in order of processors (printed, all write one);
// - the translation table is indexed by where it leads away from (printed, by the row's label);
// - idle time is that of both steps, so that waiting between them counts;
// - the split level's controller: see split_level.h.
template <class Tree>
std::unique_ptr<PublishedWalk> make_a2ssb(PublishedAlgorithm algorithm, const Tree& tree, ThreadTeam& team);

// One processor: kAlgo4, kAlgo5 and kAlgo4Lanes. The clock is the team's.
template <class Tree>
std::unique_ptr<PublishedWalk> make_single(PublishedAlgorithm algorithm, const Tree& tree,
                                           const ThreadTeam& team);

}  // namespace swath
