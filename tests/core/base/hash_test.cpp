#include "core/base/hash.h"

#include <gtest/gtest.h>

namespace coppice {
namespace {

// FIPS 180-4, example "abc".
TEST(Sha256, matches_the_published_example) {
    EXPECT_EQ(sha256_hex(as_bytes("abc")),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, of_parts_equals_that_of_the_whole) {
    Sha256 hash;
    hash.update(as_bytes("ab"));
    hash.update(as_bytes("c"));
    EXPECT_EQ(hash.finish_hex(), sha256_hex(as_bytes("abc")));
}

}  // namespace
}  // namespace coppice
