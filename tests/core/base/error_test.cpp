#include "core/base/error.h"

#include <gtest/gtest.h>

#include <set>

namespace coppice {
namespace {

TEST(Error, every_code_has_a_name_of_its_own) {
    std::set<std::string_view> names;
    for (int code = 0; code < static_cast<int>(ErrorCode::count_); ++code) {
        names.insert(name(static_cast<ErrorCode>(code)));
    }
    EXPECT_EQ(names.size(), static_cast<size_t>(ErrorCode::count_));
}

TEST(Error, require_throws_with_code_place_and_message) {
    try {
        require(false, ErrorCode::asset_malformed, "/accessors/7", "accessor {} ends at byte {}", 7, 4100);
        FAIL() << "require let a false condition pass";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::asset_malformed);
        EXPECT_EQ(error.where(), "/accessors/7");
        EXPECT_EQ(error.message(), "accessor 7 ends at byte 4100");
    }
}

TEST(Error, require_lets_a_true_condition_pass) {
    EXPECT_NO_THROW(require(true, ErrorCode::internal, "", "never seen"));
}

}  // namespace
}  // namespace coppice
