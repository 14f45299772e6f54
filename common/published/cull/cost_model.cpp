#include "common/published/cull/cost_model.h"

#include <cmath>

namespace swath {
namespace {

double power_of_eight(int exponent) { return std::ldexp(1.0, 3 * exponent); }

}  // namespace

double nodes_up_to(int level) { return (power_of_eight(level + 1) - 1) / 7; }

double A2ssbCost::step_one_nodes() const { return nodes_up_to(split_level) - nodes_up_to(start_level); }

double A2ssbCost::step_one() const { return step_one_nodes() / processors; }

double A2ssbCost::nodes_per_processor() const { return power_of_eight(split_level + 1) / processors; }

double A2ssbCost::transfer() const { return nodes_per_processor() * (processors - 1); }

int A2ssbCost::subtree_height() const { return height - (split_level + 1); }

double A2ssbCost::subtree_nodes() const { return nodes_up_to(subtree_height()); }

double A2ssbCost::step_two() const { return nodes_per_processor() * subtree_nodes(); }

double A2ssbCost::total() const { return step_one() + step_two() + transfer(); }

double A2ssbCost::roughly_total() const { return power_of_eight(height + 1) / (7.0 * processors); }

double A2ssbCost::transfer_to_navigation() const { return transfer() / roughly_total(); }

}  // namespace swath
