#pragma once

namespace swath {

// A2SSB's cost if the whole tree is visible, in nodes that a processor tests or is given: equations 10 to 29
// of the chapter (section 3.9). Equation 30 says that on a given machine equation 29 is proportional to 8^h.
// Levels count from 0 at the root, so h = 8 is a tree of "9 levels". 0 <= r <= d <= h, p >= 1.
struct A2ssbCost {
    int height;       // h, of the octree
    int start_level;  // r
    int split_level;  // d
    int processors;   // p

    // Equation 11: S_delta = n_d - n_r, as printed. It leaves out the 8^r nodes of the start level, which
    // step one tests, too.
    double step_one_nodes() const;
    double step_one() const;                // S1: equations 10 and 16
    double nodes_per_processor() const;     // n_p: equation 18
    double transfer() const;                // T: equations 17 and 19
    int subtree_height() const;             // h_S2: equation 20
    double subtree_nodes() const;           // n_S2: equation 22
    double step_two() const;                // S2: equations 21, 23 and 24
    double total() const;                   // C: equations 9 and 25
    double roughly_total() const;           // equation 29
    double transfer_to_navigation() const;  // equations 26 to 28
};

// Equations 12, 14 and 15: all nodes of levels 0 to `level`; 0 for level -1.
double nodes_up_to(int level);

}  // namespace swath
