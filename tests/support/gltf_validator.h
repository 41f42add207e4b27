// Khronos' glTF validator, run once over a batch of results: starting Node.js takes longer than most files
// do.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/format/asset.h"

namespace coppice::test {

// Keeps the files in a temporary folder of its own until it is destroyed.
class ValidatorBatch {
  public:
    ValidatorBatch();
    ~ValidatorBatch();
    ValidatorBatch(const ValidatorBatch&) = delete;
    ValidatorBatch& operator=(const ValidatorBatch&) = delete;

    // A GLB, or a zip with one .gltf and its resources. name: for messages, unique in the batch.
    void add(std::string_view name, const WrittenAsset& asset);
    size_t size() const { return files_.size(); }

    // Fails, with the validator's words, if a file has an error or the validator could not be run.
    ::testing::AssertionResult has_no_errors() const;

  private:
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> files_;
};

}  // namespace coppice::test
