#include "cli/run.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace coppice {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

namespace fs = std::filesystem;

// A folder of its own, and the command line in it.
class CommandLine : public testing::Test {
  protected:
    CommandLine() {
        std::string pattern = (fs::temp_directory_path() / "coppice-cli-XXXXXX").string();
        folder_ = mkdtemp(pattern.data());
    }
    ~CommandLine() override { fs::remove_all(folder_); }
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    int run(const std::vector<std::string>& arguments, bool shows_progress = false) {
        out_.str("");
        err_.str("");
        return coppice::run(arguments, {.out = out_, .err = err_, .shows_progress = shows_progress});
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string content(const std::string& name) const {
        std::ifstream file(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void make_sample(const std::string& name) {
        ASSERT_EQ(run({"sample", "cad", "-o", path(name), "--copies", "14", "--triangles", "200"}), 0)
            << err();
    }
    std::string out() const { return out_.str(); }
    std::string err() const { return err_.str(); }

    fs::path folder_;
    std::ostringstream out_, err_;
};

TEST_F(CommandLine, makes_a_sample_and_optimizes_it) {
    make_sample("in.glb");
    EXPECT_THAT(content("in.glb"), StartsWith("glTF"));
    EXPECT_THAT(err(), HasSubstr("3 unique meshes, 14 instances"));
    ASSERT_EQ(run({"optimize", path("in.glb"), "-o", path("out.glb"), "--ratio", "0.5"}), 0) << err();
    EXPECT_LT(content("out.glb").size(), content("in.glb").size());
    EXPECT_THAT(err(), HasSubstr("3 unique meshes, 14 instances"));
    EXPECT_THAT(err(), HasSubstr("simplify"));
    EXPECT_EQ(out(), "");
}

TEST_F(CommandLine, takes_the_format_from_the_name_unless_it_is_told) {
    make_sample("in.glb");
    ASSERT_EQ(run({"optimize", path("in.glb"), "-o", path("out.iobj")}), 0) << err();
    EXPECT_THAT(content("out.iobj"), StartsWith("#@iobj 1.0"));
    ASSERT_EQ(run({"optimize", path("in.glb"), "-o", path("out.bin"), "--format", "glb"}), 0) << err();
    EXPECT_THAT(content("out.bin"), StartsWith("glTF"));
    EXPECT_EQ(run({"optimize", path("in.glb"), "-o", path("out.stl")}), 2);
    EXPECT_THAT(err(), HasSubstr(".glb, .gltf, .obj, .iobj or .zip"));
}

TEST_F(CommandLine, lays_files_out_beside_a_gltf_and_reads_them_from_there) {
    make_sample("scene.gltf");
    EXPECT_THAT(content("scene.gltf"), HasSubstr("scene.bin"));
    EXPECT_THAT(content("scene.bin"), Not(testing::IsEmpty()));
    EXPECT_THAT(content("steel.png"), HasSubstr("PNG"));
    ASSERT_EQ(run({"optimize", path("scene.gltf"), "-o", path("small.gltf"), "--report", "-"}), 0) << err();
    EXPECT_THAT(out(), HasSubstr("\"instances\":14"));
    EXPECT_THAT(content("small.bin"), Not(testing::IsEmpty()));
}

TEST_F(CommandLine, keeps_a_zip_where_the_name_says_so) {
    make_sample("scene.zip");
    EXPECT_THAT(content("scene.zip"), StartsWith("PK"));
    EXPECT_EQ(run({"inspect", path("scene.zip")}), 0) << err();
    EXPECT_THAT(out(), HasSubstr("14 instances"));
}

TEST_F(CommandLine, does_not_replace_a_different_file_that_is_in_the_way) {
    std::ofstream(folder_ / "steel.png") << "somebody's picture";
    EXPECT_EQ(run({"sample", "cad", "-o", path("scene.gltf"), "--copies", "7", "--triangles", "100"}), 1);
    EXPECT_THAT(err(), HasSubstr("steel.png"));
    EXPECT_EQ(content("steel.png"), "somebody's picture");
    EXPECT_FALSE(fs::exists(folder_ / "scene.gltf"));
}

TEST_F(CommandLine, takes_parameters_of_algorithms) {
    make_sample("in.glb");
    ASSERT_EQ(run({"optimize", path("in.glb"), "-o", path("out.glb"), "--parameters.mode", "faithful",
                   "--report", path("report.json")}),
              0)
        << err();
    EXPECT_THAT(content("report.json"), HasSubstr("faithful"));
}

TEST_F(CommandLine, exits_with_2_for_wrong_usage_and_names_what_is_wrong) {
    make_sample("in.glb");
    EXPECT_EQ(run({}), 2);
    EXPECT_EQ(run({"optimise"}), 2);
    EXPECT_EQ(run({"optimize", path("in.glb")}), 2);
    EXPECT_EQ(run({"optimize", path("in.glb"), "-o", path("o.glb"), "--rato", "0.5"}), 2);
    EXPECT_THAT(err(), HasSubstr("--rato"));
    for (const char* ratio : {"0", "1.5", "abc"}) {
        EXPECT_EQ(run({"optimize", path("in.glb"), "-o", path("o.glb"), "--ratio", ratio}), 2) << ratio;
        EXPECT_THAT(err(), HasSubstr("ratio is"));
    }
    EXPECT_EQ(run({"sample", "jungle", "-o", path("o.glb")}), 2);
    EXPECT_FALSE(fs::exists(folder_ / "o.glb"));
}

TEST_F(CommandLine, exits_with_1_when_the_work_fails) {
    EXPECT_EQ(run({"optimize", path("nothing.glb"), "-o", path("o.glb")}), 1);
    std::ofstream(folder_ / "broken.glb") << "glTF";
    EXPECT_EQ(run({"optimize", path("broken.glb"), "-o", path("o.glb")}), 1);
    EXPECT_THAT(err(), StartsWith("coppice: asset.malformed: "));
    make_sample("in.glb");
    EXPECT_EQ(run({"optimize", path("in.glb"), "-o", path("no/such/folder/o.glb")}), 1);
}

TEST_F(CommandLine, does_not_read_outside_of_the_assets_folder) {
    fs::create_directory(folder_ / "sub");
    std::ofstream(folder_ / "secret.bin") << "0123456789";
    std::ofstream(folder_ / "sub" / "scene.gltf")
        << R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":10,"uri":"../secret.bin"}]})";
    EXPECT_EQ(run({"inspect", path("sub/scene.gltf")}), 1);
    EXPECT_THAT(err(), HasSubstr("resource.forbidden"));
}

TEST_F(CommandLine, shows_progress_only_on_a_terminal) {
    make_sample("in.glb");
    run({"optimize", path("in.glb"), "-o", path("o.glb")}, true);
    EXPECT_THAT(err(), HasSubstr("\r"));
    run({"optimize", path("in.glb"), "-o", path("o.glb")}, false);
    EXPECT_THAT(err(), Not(HasSubstr("\r")));
}

TEST_F(CommandLine, tells_its_version_its_algorithms_and_how_it_is_used) {
    EXPECT_EQ(run({"--version"}), 0);
    EXPECT_THAT(out(), StartsWith("coppice " COPPICE_VERSION));
    EXPECT_EQ(run({"algorithms"}), 0);
    EXPECT_THAT(out(), HasSubstr("its (default)"));
    EXPECT_EQ(run({"algorithms", "--json"}), 0);
    EXPECT_THAT(out(), HasSubstr("\"algorithms\":[{\"id\":\"its\""));
    EXPECT_EQ(run({"--help"}), 0);
    EXPECT_THAT(out(), HasSubstr("coppice optimize forest.glb -o small.glb"));
    EXPECT_EQ(run({"optimize", "--help"}), 0);
    EXPECT_THAT(out(), HasSubstr("--parameters.mode"));
    EXPECT_EQ(run({"sample", "--help"}), 0);
    EXPECT_THAT(out(), HasSubstr("bunny13"));
}

TEST_F(CommandLine, shows_the_settings_of_the_service_that_are_in_effect) {
    EXPECT_EQ(run({"serve", "--listen", "127.0.0.1:9", "--allow-anonymous", "--print-config"}), 0) << err();
    EXPECT_THAT(out(), HasSubstr("127.0.0.1:9"));
    EXPECT_THAT(out(), HasSubstr("allow_anonymous = true"));
    EXPECT_EQ(run({"serve", "--listen", "nowhere"}), 2);
    EXPECT_EQ(run({"serve", "--lisen", "127.0.0.1:9"}), 2);
    EXPECT_EQ(run({"serve", "--help"}), 0);
    EXPECT_THAT(out(), HasSubstr("--listen"));
}

TEST_F(CommandLine, inspects_as_json) {
    make_sample("in.glb");
    EXPECT_EQ(run({"inspect", path("in.glb"), "--json"}), 0);
    EXPECT_THAT(out(), HasSubstr("\"instances\":14"));
}

}  // namespace
}  // namespace coppice
