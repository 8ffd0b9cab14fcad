/// Manual pages, completion and the version say what the program says of itself elsewhere: in its help.
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/app/small_experiment.h"
#include "tests/support/program.h"

using namespace overt;
using test::run_overt;
namespace fs = std::filesystem;

namespace {

/// The first group of each match.
std::set<std::string> all_matches(const std::string& text, const std::string& pattern) {
    const std::regex expression(pattern, std::regex::multiline);
    std::set<std::string> found;
    for (auto match = std::sregex_iterator(text.begin(), text.end(), expression);
         match != std::sregex_iterator(); ++match)
        found.insert((*match)[1]);
    return found;
}

/// "check", "tracker calibrate", …, by the help alone.
std::set<std::string> commands_below(const std::vector<std::string>& path) {
    std::vector<std::string> call = path;
    call.emplace_back("--help");
    const std::string help = run_overt(call).out;
    const std::size_t list = help.find("\nSubcommands:\n");
    std::set<std::string> all;
    if (list == std::string::npos)
        return all;
    const std::string commands = help.substr(list, help.find("\n\n", list) - list);
    for (const std::string& name : all_matches(commands, "^  ([a-z-]+)( |$)")) {
        std::vector<std::string> below = path;
        below.push_back(name);
        std::string words;
        for (const std::string& word : below)
            words += words.empty() ? word : fmt::format(" {}", word);
        all.insert(words);
        all.merge(commands_below(below));
    }
    return all;
}

/// The options that the help of a command names at the beginnings of lines.
std::set<std::string> options_in_help_of(const std::string& command) {
    std::istringstream words(command);
    std::vector<std::string> call{std::istream_iterator<std::string>(words), {}};
    call.emplace_back("--help");
    return all_matches(run_overt(call).out, "^ {2,4}(?:-[a-zA-Z],)?(--[a-z0-9-]+)");
}

std::string without_escapes(const std::string& page) {
    return std::regex_replace(page, std::regex(R"(\\-)"), "-");
}

/// What bash offers for the last of the words.
std::set<std::string> completed(const fs::path& script, const std::vector<std::string>& words,
                                const fs::path& in) {
    const test::TemporaryFolder folder;
    const fs::path out = folder.path() / "out";
    std::string array;
    for (const std::string& word : words)
        array += fmt::format(" {}", test::quoted_for_shell(word));
    const std::string call = fmt::format(
        "cd {}; source {}; COMP_WORDS=({}{}); COMP_CWORD={}; _overt; printf '%s\\n' "
        "\"${{COMPREPLY[@]}}\" >{}",
        test::quoted_for_shell(in.string()), test::quoted_for_shell(script.string()),
        test::quoted_for_shell(OVERT_PROGRAM), array, words.size(), test::quoted_for_shell(out.string()));
    REQUIRE(std::system(fmt::format("bash -c {}", test::quoted_for_shell(call)).c_str()) == 0);
    return all_matches(test::text_of(out), "^(.+)$");
}

} // namespace

TEST_CASE("each command has a manual page, with each option of its help", "[unit][manual]") {
    const test::TemporaryFolder folder;
    const fs::path pages = folder.path() / "man1";
    REQUIRE(run_overt({"man-pages", pages.string()}).exit_code == 0);
    const std::set<std::string> commands = commands_below({});
    REQUIRE(commands.contains("run"));
    REQUIRE(commands.contains("tracker calibrate"));
    for (const std::string& command : commands) {
        CAPTURE(command);
        const fs::path file =
            pages / fmt::format("overt-{}.1", std::regex_replace(command, std::regex(" "), "-"));
        REQUIRE(fs::exists(file));
        const std::string page = without_escapes(test::text_of(file));
        const std::set<std::string> options = options_in_help_of(command);
        CHECK_FALSE(options.empty());
        for (const std::string& option : options)
            CHECK(page.find(fmt::format("\\fB{}\\fR", option)) != std::string::npos);
    }
    // And none of a command that is not there; the one of the program itself apart.
    CHECK(std::distance(fs::directory_iterator(pages), fs::directory_iterator()) ==
          static_cast<std::ptrdiff_t>(commands.size() + 1));
    CHECK_FALSE(commands.contains("man-pages"));
}

TEST_CASE("bash completes commands, options, their choices and files", "[unit][manual]") {
    const test::TemporaryFolder folder;
    const fs::path script = folder.file("overt.bash", run_overt({"completion", "bash"}).out);
    folder.file("files/mine.toml", "");
    folder.file("files/mine.png", "");
    folder.file("files/mine_sessions/empty", "");
    const fs::path in = folder.path() / "files";
    using Words = std::set<std::string>;
    CHECK(completed(script, {"exp"}, in) == Words{"export"});
    CHECK(completed(script, {"tracker", "cal"}, in) == Words{"calibrate"});
    CHECK(completed(script, {"run", "mine.toml", "--context", "e"}, in) == Words{"egl"});
    CHECK(completed(script, {"run", "mine.toml", "--context", "=", "o"}, in) == Words{"osmesa"});
    CHECK(completed(script, {"run", "mine.toml", "--virt"}, in) == Words{"--virtual-time"});
    CHECK(completed(script, {"run", "mi"}, in) == Words{"mine.toml", "mine_sessions"});
    CHECK(completed(script, {"export", "mi"}, in) == Words{"mine_sessions"});
    // An observer's label is nobody's to guess.
    CHECK(completed(script, {"run", "mine.toml", "--observer", ""}, in).empty());
    // Each option of each command is offered where it stands.
    for (const std::string& command : commands_below({})) {
        std::istringstream parts(command);
        std::vector<std::string> words{std::istream_iterator<std::string>(parts), {}};
        words.emplace_back("--");
        CAPTURE(command);
        CHECK(completed(script, words, in) == options_in_help_of(command));
    }
}

TEST_CASE("bash completes what the protocol or the session on the line knows", "[session][manual]") {
    const test::SmallExperiment experiment;
    const test::TemporaryFolder folder;
    const fs::path script = folder.file("overt.bash", run_overt({"completion", "bash"}).out);
    const fs::path in = experiment.protocol().parent_path();
    using Words = std::set<std::string>;
    const Words stimuli{"bust/smooth", "bust/matt", "tall/smooth", "tall/matt"};
    CHECK(completed(script, {"play", "small.toml", "--stimulus", ""}, in) == stimuli);
    CHECK(completed(script, {"play", "small.toml", "--stimulus", "tall/m"}, in) == Words{"tall/matt"});
    CHECK(completed(script, {"play", "small.toml", "--stimulus", "=", "bu"}, in) ==
          Words{"bust/smooth", "bust/matt"});
    CHECK(completed(script, {"bake", "small.toml", "--quality", "draft", "--stimulus", ""}, in) == stimuli);
    CHECK(completed(script, {"display", "verify", "small.toml", "--stimulus", ""}, in) == stimuli);
    CHECK(completed(script, {"lut", "small.toml", "--stimulus", ""}, in) == Words{"bust", "tall"});
    // Without a protocol on the line, or with one that cannot be read, nobody knows.
    CHECK(completed(script, {"play", "--stimulus", ""}, in).empty());
    fs::copy_file(in / "small.toml", in / "my small.toml");
    CHECK(completed(script, {"play", "my\\ small.toml", "--stimulus", "tall/m"}, in) == Words{"tall/matt"});
    std::ofstream(in / "wrong.toml") << "[protocol\n";
    CHECK(completed(script, {"play", "wrong.toml", "--stimulus", ""}, in).empty());

    REQUIRE(experiment.run({"--trials", "3"}).exit_code == 0);
    const std::string session = experiment.session().string();
    CHECK(completed(script, {"show", session, "--trial", ""}, in) == Words{"1", "2", "3"});
    CHECK(completed(script, {"replay", session, "--trial", ""}, in) == Words{"1", "2", "3"});
    CHECK(completed(script, {"show", in.string(), "--trial", ""}, in).empty());
}

TEST_CASE("the version names commit, build, compiler and libraries", "[unit][manual]") {
    const std::string version = run_overt({"--version"}).out;
    CHECK(version.starts_with("overt 0."));
    for (const char* line : {"commit", "build", "compiler", "flags", "libraries"})
        CHECK(all_matches(version, fmt::format("^{} +(.+)$", line)).size() == 1);
    for (const char* library : {"CLI11", "Embree", "GLFW", "OpenImageIO", "SQLite", "Pango"})
        CHECK(all_matches(version, fmt::format("[ ,]{} ([0-9][0-9.]*)", library)).size() == 1);
}
