#include "cli/run.h"

#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

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

TEST_F(CommandLine, takes_the_format_from_the_names_ending) {
    make_sample("in.glb");
    ASSERT_EQ(run({"optimize", path("in.glb"), "-o", path("out.iobj")}), 0) << err();
    EXPECT_THAT(content("out.iobj"), StartsWith("#@iobj 1.0"));
    ASSERT_EQ(run({"optimize", path("in.glb"), "-o", path("out.GLB"), "--format", "glb"}), 0) << err();
    EXPECT_THAT(content("out.GLB"), StartsWith("glTF"));
}

TEST_F(CommandLine, takes_the_format_that_is_told_for_a_name_that_asks_for_none) {
    make_sample("in.glb");
    ASSERT_EQ(run({"optimize", path("in.glb"), "-o", path("out.tmp"), "--format", "glb"}), 0) << err();
    EXPECT_THAT(content("out.tmp"), StartsWith("glTF"));
    ASSERT_EQ(run({"optimize", path("in.glb"), "-o", path("bare"), "--format", "gltf"}), 0) << err();
    EXPECT_THAT(content("bare"), StartsWith("PK"));
    EXPECT_FALSE(fs::exists(folder_ / "bare.bin"));
}

TEST_F(CommandLine, refuses_a_name_that_contradicts_the_format_and_says_what_would_be_right) {
    make_sample("in.glb");
    const auto refused = [&](const std::string& name, const std::string& format) {
        std::vector<std::string> arguments = {"optimize", path("in.glb"), "-o", path(name)};
        if (!format.empty()) arguments.insert(arguments.end(), {"--format", format});
        EXPECT_EQ(run(arguments), 2) << name << " " << format;
        EXPECT_FALSE(fs::exists(folder_ / name));
        return err();
    };
    EXPECT_THAT(refused("x.glb", "gltf"), HasSubstr("x.glb asks for glb, but --format is gltf; end the name "
                                                    "with .gltf, or leave --format out"));
    EXPECT_THAT(refused("x.zip", "glb"), HasSubstr("end the name with .glb, or give --format gltf"));
    EXPECT_THAT(refused("x.stl", ""), HasSubstr("is read and not written"));
    EXPECT_THAT(refused("x.tmp", ""), HasSubstr(".glb, .gltf, .obj, .iobj or .zip, or give --format"));
    EXPECT_FALSE(fs::exists(folder_ / "x.gltf"));
}

TEST_F(CommandLine, writes_a_zip_of_a_gltf_or_of_the_obj_that_is_told) {
    make_sample("in.glb");
    ASSERT_EQ(run({"optimize", path("in.glb"), "-o", path("out.zip")}), 0) << err();
    EXPECT_THAT(content("out.zip"), StartsWith("PK"));
    EXPECT_THAT(content("out.zip"), HasSubstr("out.gltf"));
    ASSERT_EQ(run({"optimize", path("in.glb"), "-o", path("objs.zip"), "--format", "iobj"}), 0) << err();
    EXPECT_THAT(content("objs.zip"), HasSubstr("objs.iobj"));
    std::ofstream(folder_ / "plain.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    ASSERT_EQ(run({"optimize", path("plain.obj"), "-o", path("plain.zip"), "--format", "obj"}), 0) << err();
    EXPECT_THAT(content("plain.zip"), StartsWith("PK"));  // though there is nothing beside the OBJ
    EXPECT_EQ(run({"inspect", path("plain.zip")}), 0) << err();
}

TEST_F(CommandLine, replaces_a_gltf_and_its_resources_as_one) {
    make_sample("scene.gltf");
    fs::create_directory(folder_ / "out");
    const auto optimize = [&](const char* ratio) {
        return run({"optimize", path("scene.gltf"), "-o", path("out/small.gltf"), "--ratio", ratio});
    };
    ASSERT_EQ(optimize("0.9"), 0) << err();
    const std::string document = content("out/small.gltf"), binary = content("out/small.bin");
    ASSERT_EQ(optimize("0.5"), 0) << err();
    EXPECT_LT(content("out/small.bin").size(), binary.size());
    ASSERT_EQ(optimize("0.9"), 0) << err();

    fs::remove(folder_ / "out" / "steel.png");
    fs::create_directory(folder_ / "out" / "steel.png");  // one of the files cannot be written
    EXPECT_EQ(optimize("0.5"), 1);
    EXPECT_THAT(err(), HasSubstr("steel.png cannot be written: a folder has this name"));
    EXPECT_TRUE(content("out/small.gltf") == document);
    EXPECT_TRUE(content("out/small.bin") == binary);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "out"), {}), 4) << "something is left over";
}

TEST_F(CommandLine, exits_with_1_where_the_port_of_the_service_is_taken_and_says_what_would_be_right) {
    const int holder = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t bytes = sizeof address;
    ASSERT_EQ(::bind(holder, reinterpret_cast<const sockaddr*>(&address), bytes), 0);
    ASSERT_EQ(::listen(holder, 1), 0);
    ASSERT_EQ(::getsockname(holder, reinterpret_cast<sockaddr*>(&address), &bytes), 0);
    const std::string taken = "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
    EXPECT_EQ(run({"serve", "--listen", taken, "--data", path("data")}), 1);
    EXPECT_THAT(err(), HasSubstr("cannot listen on " + taken + ": Address already in use; end what listens"));
    EXPECT_THAT(err(), HasSubstr("--listen ADDRESS:PORT"));
    ::close(holder);
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
    for (const char* output : {"scene.gltf", "steel.gltf"}) {
        EXPECT_EQ(run({"sample", "cad", "-o", path(output), "--copies", "7", "--triangles", "100"}), 1);
        EXPECT_THAT(err(), HasSubstr("steel.png"));
        EXPECT_EQ(content("steel.png"), "somebody's picture");
        EXPECT_FALSE(fs::exists(folder_ / output));
    }
}

TEST_F(CommandLine, writes_to_where_a_link_points_though_nothing_is_there_yet) {
    make_sample("in.glb");
    fs::create_directory(folder_ / "sub");
    fs::create_symlink("sub/second.glb", folder_ / "first.glb");
    fs::create_symlink("real.glb", folder_ / "sub" / "second.glb");
    for (const char* ratio : {"0.9", "0.5"}) {  // the second time it is there
        ASSERT_EQ(run({"optimize", path("in.glb"), "-o", path("first.glb"), "--ratio", ratio}), 0) << err();
        EXPECT_TRUE(fs::is_symlink(folder_ / "first.glb"));
        EXPECT_TRUE(fs::is_symlink(folder_ / "sub" / "second.glb"));
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder_ / "sub" / "real.glb")));
        EXPECT_THAT(content("sub/real.glb"), StartsWith("glTF"));
    }
}

TEST_F(CommandLine, refuses_a_link_that_leads_nowhere_and_says_so) {
    make_sample("in.glb");
    const auto refused = [&](const std::string& target) {
        fs::create_symlink(target, folder_ / "link.glb");
        EXPECT_EQ(run({"optimize", path("in.glb"), "-o", path("link.glb")}), 1);
        EXPECT_EQ(fs::read_symlink(folder_ / "link.glb"), target);
        fs::remove(folder_ / "link.glb");
        return err();
    };
    EXPECT_THAT(refused("no/such/folder/out.glb"),
                HasSubstr("link.glb cannot be written: is its folder there"));
    EXPECT_THAT(refused("link.glb"),
                HasSubstr("link.glb cannot be written: it is a link that leads back to itself"));
}

TEST_F(CommandLine, counts_one_as_one) {
    std::ofstream(folder_ / "one.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    EXPECT_EQ(run({"inspect", path("one.obj")}), 0) << err();
    EXPECT_THAT(out(), HasSubstr("1 unique mesh, 1 instance, 1 node, "));
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
    EXPECT_EQ(run({"optimize", path("in.glb"), path("more.glb"), "-o", path("o.glb")}), 2);
    EXPECT_THAT(err(), HasSubstr("more.glb"));
    for (const char* ratio : {"0", "1.5", "abc"}) {
        EXPECT_EQ(run({"optimize", path("in.glb"), "-o", path("o.glb"), "--ratio", ratio}), 2) << ratio;
        EXPECT_THAT(err(), HasSubstr("ratio is"));
    }
    EXPECT_EQ(run({"sample", "jungle", "-o", path("o.glb")}), 2);
    EXPECT_FALSE(fs::exists(folder_ / "o.glb"));
}

TEST_F(CommandLine, names_the_flag_that_was_probably_meant) {
    const std::vector<std::string> optimize = {"optimize", path("in.glb"), "-o", path("o.glb")};
    const auto refused = [&](std::vector<std::string> arguments, const std::vector<std::string>& flags) {
        arguments.insert(arguments.end(), flags.begin(), flags.end());
        EXPECT_EQ(run(arguments), 2);
        return err();
    };
    EXPECT_THAT(
        refused(optimize, {"--rato", "0.5"}),
        StartsWith("coppice: option.unknown: --rato is not an option; did you mean --ratio? (options"));
    EXPECT_THAT(refused(optimize, {"--rato=0.5"}),
                HasSubstr("--rato is not an option; did you mean --ratio?"));
    EXPECT_THAT(refused(optimize, {"--parameters.mod", "full"}),
                HasSubstr("did you mean --parameters.mode?"));
    EXPECT_THAT(refused(optimize, {"--compression", "draco"}),
                HasSubstr("--compression is not an option in this version"));
    EXPECT_THAT(refused({"serve"}, {"--lisen", "127.0.0.1:9"}), HasSubstr("did you mean --listen?"));
    EXPECT_FALSE(fs::exists(folder_ / "o.glb"));
}

TEST_F(CommandLine, refuses_an_instancing_that_is_not_written_before_it_reads_anything) {
    EXPECT_EQ(run({"optimize", path("not-there.glb"), "-o", path("o.glb"), "--instancing", "gpu"}), 2);
    EXPECT_THAT(err(), HasSubstr("instancing is gpu; it takes auto, nodes or expand"));
}

TEST_F(CommandLine, takes_no_negative_number_for_a_count) {
    for (const char* flag : {"--seed", "--copies", "--triangles"}) {
        EXPECT_EQ(run({"sample", "cad", "-o", path("o.glb"), flag, "-1"}), 2) << flag;
        EXPECT_THAT(err(), HasSubstr(flag)) << err();
    }
    make_sample("in.glb");
    EXPECT_EQ(run({"optimize", path("in.glb"), "-o", path("o.glb"), "--threads", "-1"}), 2);
    EXPECT_THAT(err(), HasSubstr("--threads"));
    EXPECT_FALSE(fs::exists(folder_ / "o.glb"));
}

TEST_F(CommandLine, advises_a_sample_only_what_it_takes) {
    EXPECT_EQ(run({"sample", "cad", "-o", path("o.xyz")}), 2);
    EXPECT_THAT(err(),
                HasSubstr("o.xyz does not say in which format to write; end the name with .glb, .gltf, "
                          ".obj, .iobj or .zip"));
    EXPECT_THAT(err(), Not(HasSubstr("--format")));
}

TEST_F(CommandLine, shows_each_command_its_own_help) {
    EXPECT_EQ(run({"serve", "--help"}), 0);
    EXPECT_THAT(out(), HasSubstr("127.0.0.1:8080]"));
    EXPECT_THAT(out(), HasSubstr("[1000]"));
    for (const char* command : {"inspect", "algorithms"}) {
        EXPECT_EQ(run({command, "--help"}), 0);
        EXPECT_THAT(out(), HasSubstr(std::string("  coppice ") + command));
        EXPECT_THAT(out(), Not(HasSubstr("coppice optimize"))) << command;
        EXPECT_THAT(out(), Not(HasSubstr("COMMAND --help"))) << command;
    }
    EXPECT_EQ(run({"sample", "--help"}), 0);
    EXPECT_THAT(out(), HasSubstr("13 copies, about 5000 triangles each"));
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
    EXPECT_THAT(out(), HasSubstr("{\"id\":\"its\","));
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

TEST_F(CommandLine, compares_an_asset_with_what_it_made_of_it) {
    make_sample("in.glb");
    ASSERT_EQ(run({"optimize", path("in.glb"), "-o", path("out.glb"), "--ratio", "0.5"}), 0) << err();
    EXPECT_EQ(run({"compare", path("in.glb"), path("out.glb")}), 0) << err();
    EXPECT_THAT(out(), HasSubstr("each unique mesh was compared once"));
    EXPECT_THAT(out(), HasSubstr("distance, model units"));
    EXPECT_THAT(out(), HasSubstr("flipped triangles: 0;"));
    EXPECT_THAT(out(), Not(HasSubstr("self-intersecting")));

    EXPECT_EQ(run({"compare", path("in.glb"), path("out.glb"), "--json", "--self_intersections", "--samples",
                   "20", "--threads", "1"}),
              0)
        << err();
    EXPECT_THAT(out(), HasSubstr("\"measured\":\"meshes\""));
    EXPECT_THAT(out(), HasSubstr("\"self_intersections\":{"));
    const std::string alone = out();
    EXPECT_EQ(run({"compare", path("in.glb"), path("out.glb"), "--json", "--self_intersections", "true",
                   "--samples", "20", "--threads", "3"}),
              0);
    EXPECT_EQ(out(), alone);
}

TEST_F(CommandLine, compares_over_formats_and_finds_nothing_between_an_asset_and_itself) {
    make_sample("in.glb");
    ASSERT_EQ(run({"optimize", path("in.glb"), "-o", path("out.obj"), "--ratio", "1"}), 0) << err();
    EXPECT_EQ(run({"compare", path("in.glb"), path("out.obj")}), 0) << err();
    EXPECT_THAT(out(), HasSubstr("the scenes were expanded"));
    EXPECT_EQ(run({"compare", path("in.glb"), path("in.glb")}), 0) << err();
    EXPECT_THAT(out(), HasSubstr("flipped triangles: 0; with their texture mirrored: 0"));
}

TEST_F(CommandLine, says_which_of_two_assets_cannot_be_compared) {
    make_sample("in.glb");
    std::ofstream(path("broken.obj")) << "v 0 0 nan\n";
    EXPECT_EQ(run({"compare", path("in.glb"), path("broken.obj")}), 1);
    EXPECT_THAT(err(), HasSubstr("the candidate: "));
    EXPECT_EQ(run({"compare", path("broken.obj"), path("in.glb")}), 1);
    EXPECT_THAT(err(), HasSubstr("the reference: "));
    std::ofstream(path("points.obj")) << "v 0 0 0\np 1\n";
    EXPECT_EQ(run({"compare", path("in.glb"), path("points.obj")}), 1);
    EXPECT_THAT(err(), HasSubstr("asset."));
    EXPECT_EQ(run({"compare", path("in.glb"), path("nothing.glb")}), 1);
    EXPECT_EQ(run({"compare", path("in.glb")}), 2);
    EXPECT_EQ(run({"compare", path("in.glb"), path("in.glb"), "--samples", "0"}), 2);
    EXPECT_EQ(run({"compare", path("in.glb"), path("in.glb"), "--sample", "3"}), 2);
    EXPECT_EQ(run({"compare", "--help"}), 0);
    EXPECT_THAT(out(), HasSubstr("--self_intersections"));
}

TEST_F(CommandLine, inspects_as_json) {
    make_sample("in.glb");
    EXPECT_EQ(run({"inspect", path("in.glb"), "--json"}), 0);
    EXPECT_THAT(out(), HasSubstr("\"instances\":14"));
}

}  // namespace
}  // namespace coppice
