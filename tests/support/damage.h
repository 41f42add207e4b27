// Damaged files: cut short, or with one byte changed. A reader either refuses them with an Error, or gives a
// scene that every later stage may trust.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string_view>

#include "core/format/asset.h"

namespace coppice::test {

// Reads the upload; success where that throws Error or gives a scene with consistent meshes, finite positions
// and a forest of nodes, which can be written as GLB and read again.
::testing::AssertionResult reads_or_refuses(const Upload& upload);

// Of the upload's asset: at most `count` prefixes evenly spaced, and all that lack at most 32 bytes.
::testing::AssertionResult survives_truncation(const Upload& upload, size_t count);

// `count` times one byte of the asset changed: place and value from the seed, half of them in the first
// `head` bytes, where formats have their headers.
::testing::AssertionResult survives_mutation(const Upload& upload, size_t count, uint64_t seed, size_t head);

}  // namespace coppice::test
