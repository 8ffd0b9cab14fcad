#include "experiment/record/manifest.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/record/session_schema.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

void put(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
}

std::vector<std::string> paths_of(const SessionManifest& manifest) {
    std::vector<std::string> paths;
    for (const SessionManifest::File& file : manifest.files)
        paths.push_back(file.path);
    return paths;
}

const SessionManifest::Program one{"overt", "1.0", std::string(64, '1')},
    other{"overt", "2.0", std::string(64, '2')};

} // namespace

TEST_CASE("a manifest's text comes back as it was, and with another byte in it not at all", "[unit]") {
    SessionManifest manifest;
    manifest.protocol = "tiny";
    manifest.observer = "AB7";
    manifest.session_number = 3;
    manifest.is_closed = true;
    manifest.programs = {one, other};
    manifest.inputs = {{"mesh bust", std::string(64, 'a')}, {"frames x", std::string(64, 'b')}};
    manifest.files = {{"a.txt", 5, std::string(64, 'c')},
                      {"maps/b.exr", 7'000'000'000, std::string(64, 'd')}};
    const std::string text = to_text(manifest);
    CHECK_THAT(text,
               Contains("\"sha256_of_the_above\": \"" +
                        hash_of_text(text.substr(0, text.find("\n  \"sha256_of_the_above\""))) + "\"\n}\n"));
    const SessionManifest read = manifest_from(text, "a");
    CHECK(read.protocol == "tiny");
    CHECK(read.observer == "AB7");
    CHECK(read.session_number == 3);
    CHECK(read.is_closed);
    CHECK(read.programs == manifest.programs);
    REQUIRE(read.inputs.size() == 2);
    CHECK(read.inputs[1].what == "frames x");
    CHECK(read.inputs[1].sha256 == std::string(64, 'b'));
    REQUIRE(read.files.size() == 2);
    CHECK(read.files[1].path == "maps/b.exr");
    CHECK(read.files[1].bytes == 7'000'000'000);
    CHECK(read.files[1].sha256 == std::string(64, 'd'));
    for (std::size_t at = 0; at < text.size(); ++at) {
        std::string changed = text;
        changed[at] ^= 1;
        CAPTURE(at);
        CHECK_THROWS_AS(manifest_from(changed, "a"), RecordError);
    }
    CHECK_THROWS_WITH(manifest_from("", "a"), Contains("is not as it was written"));
    const SessionManifest empty = manifest_from(to_text(SessionManifest()), "a");
    CHECK(empty.files.empty());
    CHECK(empty.inputs.empty());
    CHECK(empty.programs.empty());
}

TEST_CASE("a manifest of a newer format is told from a damaged one", "[unit]") {
    std::string text = to_text(SessionManifest());
    text.replace(text.find("\"format\": 1"), 11, "\"format\": 2");
    const std::string above = text.substr(0, text.find("\n  \"sha256_of_the_above\""));
    CHECK_THROWS_WITH(
        manifest_from(above + "\n  \"sha256_of_the_above\": \"" + hash_of_text(above) + "\"\n}\n", "a"),
        Contains("written by a newer overt"));
}

TEST_CASE("a manifest names the session's own files, and nothing that is made of them or will change",
          "[unit]") {
    const TemporaryFolder root;
    const std::string session = session_file_name;
    for (const std::string& name : {std::string("b.txt"),
                                    std::string("a/b/c.txt"),
                                    session,
                                    session + "-wal",
                                    session + "-shm",
                                    session + "-journal",
                                    std::string(manifest_file_name),
                                    std::string(".hidden"),
                                    std::string(".folder/x.txt"),
                                    std::string("a/.hidden"),
                                    std::string("export_bids/x.tsv"),
                                    std::string("export_list.txt"),
                                    std::string("a/export_bids/x.tsv"),
                                    std::string("trackers/two/x.txt"),
                                    std::string("a/trackers/x.txt"),
                                    std::string("b.txt.part"),
                                    std::string("b.part.txt"),
                                    "a/" + session,
                                    "a/" + session + "-wal",
                                    "a/" + std::string(manifest_file_name)})
        put(root.path() / name, name);
    fs::create_symlink("b.txt", root.path() / "link.txt");
    fs::create_directory_symlink("a", root.path() / "link");
    std::vector<std::string> expected{"a/b/c.txt",
                                      "a/export_bids/x.tsv",
                                      "a/manifest.json",
                                      "a/" + session,
                                      "a/" + session + "-wal",
                                      "a/trackers/x.txt",
                                      "b.part.txt",
                                      "b.txt",
                                      "export_list.txt"};
    CHECK(files_of_session(root.path(), false) == expected);
    expected.push_back(session);
    CHECK(files_of_session(root.path(), true) == expected);
}

TEST_CASE("a file of a session keeps the hash that it had first, and the session's is of its end", "[unit]") {
    const TemporaryFolder root;
    const fs::path folder = root.path(), session = folder / session_file_name;
    SessionHeader header = example_header();
    header.objects[0].surface_sha256 = std::string(64, '9');
    header.stimuli[0].frames_sha256.clear();
    header.characterisation.emplace().sha256 = std::string(64, '8');
    put(folder / "a.txt", "early");
    put(session, "begun");
    begin_manifest(folder, header, one);
    SessionManifest read = read_manifest(folder);
    CHECK(read.protocol == "tiny");
    CHECK(read.observer == "AB7");
    CHECK(read.session_number == 3);
    CHECK_FALSE(read.is_closed);
    CHECK(read.programs == std::vector{one});
    CHECK(paths_of(read) == std::vector<std::string>{"a.txt"});
    std::vector<std::pair<std::string, std::string>> inputs;
    for (const SessionManifest::Input& input : read.inputs)
        inputs.emplace_back(input.what, input.sha256);
    CHECK(inputs == std::vector<std::pair<std::string, std::string>>{
                        {"mesh bust", std::string(64, 'a')},
                        {"mesh vase", std::string(64, 'b')},
                        {"surface bust", std::string(64, '9')},
                        {"frames bust/gold", std::string(64, 'f')},
                        {"frames vase/silver", ""},
                        {"characterisation of the display", std::string(64, '8')}});

    put(folder / "a.txt", "changed");
    put(folder / "0.txt", "late");
    put(session, "ended");
    put(session.string() + "-wal", "x");
    CHECK_FALSE(close_manifest(folder));
    CHECK_FALSE(read_manifest(folder).is_closed);
    put(session.string() + "-wal", "");
    REQUIRE(close_manifest(folder));
    read = read_manifest(folder);
    CHECK(read.is_closed);
    CHECK(paths_of(read) == std::vector<std::string>{"0.txt", "a.txt", session_file_name});
    CHECK(read.files[0].sha256 == hash_of_text("late"));
    CHECK(read.files[0].bytes == 4);
    CHECK(read.files[1].sha256 == hash_of_text("early"));
    CHECK(read.files[2].sha256 == hash_of_text("ended"));

    // Gone on with by a newer program, and by the same once more.
    reopen_manifest(folder, header, other);
    reopen_manifest(folder, header, other);
    read = read_manifest(folder);
    CHECK_FALSE(read.is_closed);
    CHECK(read.programs == std::vector{one, other});
    CHECK(paths_of(read) == std::vector<std::string>{"0.txt", "a.txt"});
    put(session, "ended again");
    REQUIRE(close_manifest(folder));
    CHECK(read_manifest(folder).files[2].sha256 == hash_of_text("ended again"));

    // One that cannot be read is made anew.
    put(folder / manifest_file_name, "{}");
    reopen_manifest(folder, header, other);
    read = read_manifest(folder);
    CHECK(read.programs == std::vector{other});
    CHECK(read.files.at(1).sha256 == hash_of_text("changed"));
}

TEST_CASE("a manifest that is not there, or is no file, is an error that names it", "[unit]") {
    const TemporaryFolder root;
    CHECK_THROWS_WITH(read_manifest(root.path()), Contains((root.path() / manifest_file_name).string() +
                                                           ": is not there, or cannot be read"));
    fs::create_directory(root.path() / manifest_file_name);
    CHECK_THROWS_WITH(read_manifest(root.path()), Contains("is not there, or cannot be read"));
}
