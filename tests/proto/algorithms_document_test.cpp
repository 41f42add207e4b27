#include "tests/proto/algorithms_document.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace coppice {
namespace {

// To renew it after a change of the code: COPPICE_RENEW_CONTRACT=1 script/test -R AlgorithmsDocument
TEST(AlgorithmsDocument, is_what_the_registry_has) {
    const std::string path = COPPICE_SOURCE_DIR "/docs/algorithms.md";
    if (std::getenv("COPPICE_RENEW_CONTRACT") != nullptr) {
        std::ofstream(path) << algorithms_document();
        GTEST_SKIP() << "renewed " << path << "; test again";
    }
    std::ifstream file(path);
    ASSERT_TRUE(file) << path;
    std::stringstream text;
    text << file.rdbuf();
    EXPECT_EQ(text.str(), algorithms_document());
}

}  // namespace
}  // namespace coppice
