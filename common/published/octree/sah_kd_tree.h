#pragma once
#include "common/base/result.h"
#include "common/octree/sah/sah_settings.h"
#include "common/octree/sah/sah_tree.h"
#include "common/octree/sah/sah_triangles.h"

namespace swath {

// The conventional, serial builder that the SAH octree is measured against. It makes a kd-tree whose planes
// are the best of all sides of all boxes, in O(n log n) by events that are sorted once (Wald and Havran 2006,
// without clipping triangles). It uses only the costs of `settings`: it has no bins, and does not bound
// duplication. Fails like SahBuilder::build.
Result<SahTree> build_sah_kd_tree(const SahTriangles& triangles, const SahSettings& settings);

}  // namespace swath
