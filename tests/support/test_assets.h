// The real files that tests run on. They are not part of the repository: $COPPICE_TEST_ASSETS names their
// folder, else
// ../shared/assets beside the checkout is looked for, and tests that need them are skipped where neither is
// there.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/format/asset.h"

namespace coppice::test {

// Null when there are none here.
std::optional<std::filesystem::path> asset_folder();
// Says where assets were looked for, and how to name another place; for GTEST_SKIP().
std::string no_assets_message();

// Every file below a folder of the assets whose name ends in one of the extensions (".glb"; any case),
// relative to asset_folder(), sorted. No assets: none. Never companions: an extension that is not listed is
// not returned.
std::vector<std::string> asset_files(std::string_view folder, const std::vector<std::string>& extensions);

// Of those, the glTF 2.0 ones: .glb and .gltf whose asset.version is "2.0".
std::vector<std::string> gltf2_files(std::string_view folder);

// file -> problem code, for files outside invalid/ that are refused on purpose, as
// tests/assets/refused_files.tsv says.
std::map<std::string, std::string> refused_files();

// "instanced/pins.glb" -> "instanced_pins_glb", for the names of parameterized tests.
std::string test_name(std::string_view file);

// The root of the checkout that the tests were built from.
std::filesystem::path source_root();

Bytes read_file(const std::filesystem::path& path);

// A file with what it refers to, as a client would upload it.
class UploadedAsset {
  public:
    explicit UploadedAsset(const std::filesystem::path& path);

    const Upload& upload() const { return upload_; }

  private:
    std::vector<std::unique_ptr<Bytes>> bytes_;  // of the asset and of its resources; stays where it is
    Upload upload_;
};

// asset_folder() / file.
UploadedAsset load_asset(std::string_view file);

}  // namespace coppice::test
