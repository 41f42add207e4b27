#include "core/base/ascii.h"

#include <gtest/gtest.h>

namespace coppice {
namespace {

TEST(Ascii, lowers_letters_and_leaves_all_other_bytes) {
    EXPECT_EQ(lower("Model/GLTF-Binary; [Z]@{"), "model/gltf-binary; [z]@{");
    EXPECT_EQ(lower("\xc3\x84"), "\xc3\x84");  // a letter beyond ASCII
}

TEST(Ascii, compares_without_regard_to_case) {
    EXPECT_TRUE(equal_ignoring_case("Close", "cLOSE"));
    EXPECT_FALSE(equal_ignoring_case("close", "closed"));
    EXPECT_FALSE(equal_ignoring_case("[", "{"));  // 32 apart, like a letter's two cases
}

TEST(Ascii, trims_blanks_at_both_ends_alone) {
    EXPECT_EQ(trim(" \ta b\t "), "a b");
    EXPECT_EQ(trim(" \t "), "");
    EXPECT_EQ(trim("\n a"), "\n a");
    EXPECT_EQ(trim(" \"10\" ", " \""), "10");
}

}  // namespace
}  // namespace coppice
