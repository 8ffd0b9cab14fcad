/// What the program says to a line that it does not know, and what lines it takes.
#include <algorithm>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/program.h"

using namespace overt;
using test::ProgramRun;
using test::run_overt;

namespace {

std::vector<std::string> words_of(const std::string& line) {
    std::istringstream words(line);
    return {std::istream_iterator<std::string>(words), {}};
}

/// The first group of each match.
std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
    const std::regex expression(pattern, std::regex::multiline);
    std::vector<std::string> found;
    for (auto match = std::sregex_iterator(text.begin(), text.end(), expression);
         match != std::sregex_iterator(); ++match)
        found.push_back((*match)[1]);
    return found;
}

std::string help_of(const std::string& command) { return run_overt(words_of(command + " --help")).out; }

/// "check", "tracker calibrate", …: those that do something, by the help alone.
std::vector<std::string> all_commands(const std::string& above = "") {
    const std::string help = help_of(above);
    const std::size_t list = help.find("\nSubcommands:\n");
    if (list == std::string::npos)
        return {above};
    std::vector<std::string> all;
    for (const std::string& name :
         matches(help.substr(list, help.find("\n\n", list) - list), "^  ([a-z-]+)(?: |$)"))
        for (const std::string& command : all_commands(above.empty() ? name : above + " " + name))
            all.push_back(command);
    return all;
}

std::vector<std::string> options_of(const std::string& command) {
    return matches(help_of(command), "^ {2,4}(?:-[a-zA-Z],)?(--[a-z0-9-]+)");
}

void check_refused(const std::string& line, const std::vector<std::string>& sayings) {
    CAPTURE(line);
    const ProgramRun run = run_overt(words_of(line));
    CAPTURE(run.err);
    CHECK(run.exit_code == 2);
    CHECK(run.out.empty());
    for (const std::string& saying : sayings)
        CHECK(run.err.find(saying) != std::string::npos);
}

} // namespace

TEST_CASE("a mistyped option, command or word is told with what was probably meant", "[unit]") {
    check_refused("run p.toml --observr 07",
                  {"overt run: there is no option --observr: did you mean --observer?"});
    check_refused("run p.toml --observer 07 -virtual-time", {"did you mean --virtual-time?"});
    check_refused("tracker calibrate p.toml --pictur=a.png", {"overt tracker calibrate", "--picture?"});
    check_refused("display colour a.toml --xzy 1 2 3", {"--xyz?"}); // one of a group of options
    // All at once, and nothing of what is missing because of it.
    check_refused("run p.toml --observr 07 --contxt osmesa", {"--observer?", "--context?"});
    CHECK(run_overt(words_of("run p.toml --observr 07")).err.find("required") == std::string::npos);
    check_refused("check p.toml --sigma 1deg", {"one of overt analyze, overt power"});
    check_refused("check p.toml --wholly-unheard-of", {"overt check --help"});
    check_refused("check p.toml another.toml", {"\"another.toml\" is one word too many"});

    check_refused("analyze s --tfce=3", {"overt analyze: --tfce takes no value"});
    check_refused("check p.toml --json=no", {"overt check: --json takes no value"});

    check_refused("rnu p.toml", {"did you mean \"run\"?"});
    check_refused("tracker lsit", {"did you mean \"list\"?"});
    check_refused("display p.toml", {"there is no command \"p.toml\"", "verify, status"});

    check_refused("run p.toml --observer 07 --context osmsea", {"--context", "did you mean \"osmesa\"?"});
    check_refused("bake p.toml --quality drafty", {"--quality", "did you mean \"draft\"?"});
    check_refused("export s --format tvs", {"--format", "did you mean \"tsv\"?"});
    check_refused("analyze s --kernel geodetic", {"--kernel", "did you mean \"geodesic\"?"});
    check_refused("completion bsh", {"did you mean \"bash\"?"});
    check_refused("bench ltu", {"did you mean \"lut\"?"});
    check_refused("run p.toml --observer 07 --tracker abacus", {"known: simulated, replay"});
    // What is missing is told by its name.
    check_refused("run p.toml", {"overt run: --observer is required"});
    check_refused("run p.toml --observer", {"overt run: --observer"});
}

TEST_CASE("each option of each command is suggested when two of its letters are swapped", "[unit]") {
    std::set<std::string> tried;
    for (const std::string& command : all_commands()) {
        const std::vector<std::string> known = options_of(command);
        for (const std::string& option : known) {
            if (option.size() < 7 || option == "--help" || !tried.insert(option).second)
                continue;
            std::string typed = option;
            const std::size_t middle =
                option[option.size() / 2] == '-' ? option.size() / 2 + 1 : option.size() / 2;
            std::swap(typed[middle], typed[middle + 1]);
            if (typed == option)
                typed.erase(middle, 1);
            CAPTURE(command, typed);
            const ProgramRun run = run_overt(words_of(command + " " + typed));
            CHECK(run.exit_code == 2);
            CHECK(run.err.find(fmt::format("did you mean {}?", option)) != std::string::npos);
        }
    }
    CHECK(tried.size() > 100);
}

TEST_CASE("one thing has one name: an option of several commands takes the same, and says the same",
          "[unit]") {
    // A text may name what the command is about; a value's name may not differ.
    std::map<std::string, std::set<std::string>> values;
    const std::set<std::string> several_kinds{"--out",   "--picture", "--format",   "--size",
                                              "--frame", "--frames",  "--samples",  "--observers",
                                              "--mode",  "--quality", "--stimulus", "--model"};
    for (const std::string& command : all_commands())
        for (const std::string& line :
             matches(help_of(command), "^ {2,4}(--[a-z0-9-]+[^ \n]*(?: [A-Z][A-Z_.a-z/]*)?)")) {
            const std::vector<std::string> parts = words_of(line);
            if (!several_kinds.contains(parts[0]))
                values[parts[0]].insert(parts.size() > 1 ? parts[1] : "");
        }
    CHECK(values.contains("--address"));
    for (const auto& [option, names] : values) {
        CAPTURE(option);
        std::string all;
        for (const std::string& name : names)
            all += name + " ";
        CAPTURE(all);
        CHECK(names.size() == 1);
    }
}

TEST_CASE("names that options had once are taken, and stand in no help", "[unit]") {
    const test::TemporaryFolder folder;
    const std::string none = (folder.path() / "none.toml").string();
    // Each of these lines is understood, and fails at the file that is not there.
    for (const std::string& line :
         {"run " + none + " --observer 07 --tracker-address=here",
          "play " + none + " --stimulus a/b --duration 2",
          "bake " + none + " --only a/b --out frames --force",
          "display characterise " + none + " --simulated 1 --force --context osmesa",
          "display colour " + none + " --xyz 1 2 3 --observer cie1931",
          "doctor --photodiode --context osmesa --protocol " + none,
          "doctor --photodiode --context osmesa --protocol=" + none})
        check_refused(line, {none});
    check_refused("watch --terminal --socket " + none, {none});
    for (const auto& [command, old] : {std::pair{"run", "--tracker-address"},
                                       {"play", "--duration"},
                                       {"bake", "--only"},
                                       {"bake", "--force"},
                                       {"watch", "--socket"},
                                       {"display characterise", "--simulated"},
                                       {"doctor", "--protocol"}}) {
        const std::vector<std::string> listed = options_of(command);
        CAPTURE(command, old);
        CHECK(std::count(listed.begin(), listed.end(), old) == 0);
    }
}

TEST_CASE("the version is told by its short name, too", "[unit]") {
    CHECK(run_overt({"-V"}).exit_code == 0);
    CHECK(run_overt({"-V"}).out == run_overt({"--version"}).out);
}
