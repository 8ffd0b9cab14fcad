#include "experiment/protocol/keys/protocol_schema.h"

#include <catch2/catch.hpp>

#include "experiment/keys/toml_tree.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "experiment/protocol/keys/protocol_starter.h"
#include "tests/experiment/protocol/protocol_fixtures.h"
#include "tests/support/json_schema.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

SchemaJson json_of(const TomlTable& table);

SchemaJson json_of(const TomlValue& value) {
    return std::visit(
        []<class Content>(const Content& content) -> SchemaJson {
            if constexpr (std::is_same_v<Content, TomlTable>) {
                return json_of(content);
            } else if constexpr (std::is_same_v<Content, TomlList>) {
                SchemaJson list = SchemaJson::array();
                for (const TomlValue& item : content)
                    list.push_back(json_of(item));
                return list;
            } else if constexpr (std::is_same_v<Content, TomlDate>) {
                return nullptr;
            } else {
                return content;
            }
        },
        value.content);
}

SchemaJson json_of(const TomlTable& table) {
    SchemaJson json = SchemaJson::object();
    for (const TomlEntry& entry : table)
        json[entry.key] = json_of(entry.value);
    return json;
}

std::vector<std::string> faults_of(std::string_view toml) {
    static const SchemaJson schema = protocol_schema();
    Diagnostics diagnostics;
    const TomlFile file = parse_toml(toml, "p.toml", diagnostics);
    REQUIRE(file.is_whole);
    return schema_faults(json_of(file.root), schema);
}

std::vector<std::string> faults_of(std::string_view toml, std::string_view more) {
    return faults_of(std::string(toml) + std::string(more));
}

} // namespace

TEST_CASE("the protocols that overt brings fit the schema", "[unit]") {
    for (const char* file : {"protocols/overt_2019.toml", "protocols/quick_look.toml"})
        CHECK(faults_of(text_of_file(source_path(file))) == std::vector<std::string>{});
    CHECK(faults_of(minimal_protocol) == std::vector<std::string>{});
}

TEST_CASE("the schema knows which depths, objects and numbered files there are", "[unit]") {
    const std::string object = "[[object]]\nid = \"b\"\nshipped = ";
    const std::string frames = "[[frames]]\nobject = \"a\"\nmaterial = \"gold\"\nfiles = ";
    for (const std::string& sound :
         {std::string("[answers]\nbits = 24\n"), object + "\"scholar\"\n", frames + "\"a/f_###.png\"\n",
          std::string("[schedule]\nrotation_seed = 2147483647\n")})
        CHECK(faults_of(minimal_protocol, sound) == std::vector<std::string>{});
    for (const std::string& faulty :
         {std::string("[answers]\nbits = 20\n"), object + "\"hermes\"\n", frames + "\"a/f.png\"\n",
          frames + "\"a_##/f_##.png\"\n", std::string("[schedule]\nrotation_seed = 2147483648\n")}) {
        CAPTURE(faulty);
        CHECK(faults_of(minimal_protocol, faulty).size() == 1);
        CHECK_FALSE(ReadText(minimal_protocol, faulty).protocol);
    }
}

TEST_CASE("what an included file may say is not missed by the schema", "[unit]") {
    const std::string nameless = "[protocol]\ntitle = \"Rest\"\n";
    CHECK(faults_of(nameless).size() == 1);
    CHECK(faults_of("include = \"names.toml\"\n" + nameless).empty());
}

TEST_CASE("what is shown beside a key in an editor has no links of a page in it", "[unit]") {
    CHECK(without_links("One; see [bake.md](bake.md). A list [x, y], two: [a.md](a.md)") ==
          "One; see docs/bake.md. A list [x, y], two: docs/a.md");
    CHECK(protocol_schema().dump().find("](") == std::string::npos);
    CHECK(protocol_starter("x").find("](") == std::string::npos);
}

TEST_CASE("what the reader refuses of a single key, the schema refuses, and the reverse", "[unit]") {
    // Values right and wrong for keys of every type.
    for (const std::string line : {"[display]\nrefresh_hz = 60",
                                   "[display]\nrefresh_hz = 0",
                                   "[display]\nrefresh_hz = \"60\"",
                                   "[display]\nwidth_px = 1920",
                                   "[display]\nwidth_px = 1920.0",
                                   "[display]\noutput = \"color++\"",
                                   "[display]\noutput = \"colour++\"",
                                   "[breaks]\nbetween_blocks = 1",
                                   "[breaks]\nevery_trials = -1",
                                   "[view]\ncamera_position = [0, -10, 2]",
                                   "[view]\ncamera_position = [0, -10]",
                                   "[schedule]\nseed = -1",
                                   "[schedule]\nseed = 18",
                                   "[block]\nid = \"a\"",
                                   "[[block]]\nid = \"a b\"",
                                   "[[block]]\nid = \"a\"\ntasks = \"free\"",
                                   "[[block]]\nid = \"a\"\ntasks = [\"free\"]",
                                   "[[block]]\nid = \"a\"\ntasks = []",
                                   "[[block]]\nid = \"a\"\ntasks = [1]",
                                   "[[block]]\nid = \"a\"\norder = \"weighted\"\nweights = [1]",
                                   "[[block]]\ntasks = [\"free\"]",
                                   "[[block]]\nid = \"a\"\norder = \"weighted\"\nweights = [-1]",
                                   "[lights]\nprobe = \"x\"",
                                   "[light]\nprob = \"x\"",
                                   "[animation]\namplitude_deg = 25",
                                   "[animation]\namplitude_deg = \"25\""}) {
        CAPTURE(line);
        const ReadText read(minimal_protocol, line + "\n");
        const bool refused = read.diagnostics.has_errors();
        CHECK(faults_of(minimal_protocol, line + "\n").empty() == !refused);
    }
}

TEST_CASE("the schema has every key, with its explanation and a default that fits it", "[unit]") {
    const SchemaJson schema = protocol_schema();
    CHECK(schema["$schema"] == "https://json-schema.org/draft/2020-12/schema");
    for (const Section& section : protocol_keys()) {
        SchemaJson found = schema["properties"].at(std::string(section.name));
        if (section.is_list())
            found = section.is_never_empty() ? found.at("anyOf").at(0) : found.at("items");
        for (const Key& key : section.keys) {
            CAPTURE(section.name, key.rule.name);
            const SchemaJson value = found["properties"].at(std::string(key.rule.name));
            CHECK_THAT(value["description"].get<std::string>(),
                       Contains(without_links(key.rule.explanation)));
            if (value.contains("default"))
                CHECK(schema_faults(value["default"], value) == std::vector<std::string>{});
        }
    }
}

TEST_CASE("a new protocol is sound, fits the schema, and explains every key", "[unit]") {
    const std::string text = protocol_starter("my_study");
    const ReadText read(text);
    CHECK(read.diagnostics.print() == "");
    REQUIRE(read.protocol);
    CHECK(read.protocol->name == "my_study");
    CHECK(read.protocol->objects.size() == 2);
    CHECK(faults_of(text) == std::vector<std::string>{});
    for (const Section& section : protocol_keys()) {
        CHECK(text.find(section.heading()) != std::string::npos);
        for (const Key& key : section.keys) {
            CAPTURE(section.name, key.rule.name);
            CHECK(text.find(fmt::format("\n# {} = ", key.rule.name)) +
                      text.find(fmt::format("\n{} = ", key.rule.name)) + 1 !=
                  std::string::npos);
        }
    }
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        CAPTURE(line);
        CHECK((line.size() <= 110 || line.find(" = ") != std::string::npos));
    }
}

TEST_CASE("a short protocol is the same experiment in lines that matter, and sound", "[unit]") {
    const std::string text = short_protocol_starter("my_study");
    const ReadText read(text), full(protocol_starter("my_study"));
    CHECK(read.diagnostics.print() == "");
    REQUIRE(read.protocol);
    CHECK(read.protocol->name == "my_study");
    CHECK(read.protocol->display.gamma == full.protocol->display.gamma);
    CHECK(read.protocol->tasks.size() == full.protocol->tasks.size());
    CHECK(read.protocol->materials.size() == full.protocol->materials.size());
    CHECK(std::count(text.begin(), text.end(), '\n') < 60);
}

TEST_CASE("a new protocol tells a long list of choices once", "[unit]") {
    const std::string text = protocol_starter("my_study");
    std::size_t lists = 0;
    for (std::size_t at = text.find("\"f11\""); at != std::string::npos; at = text.find("\"f11\"", at + 1))
        ++lists;
    CHECK(lists == 1);
}

TEST_CASE("the defaults that a new protocol shows as comments are what the reader takes", "[unit]") {
    // Every commented line with a value, uncommented where that is all its section needs.
    const std::string text = protocol_starter("my_study");
    std::string changed;
    std::istringstream lines(text);
    int count = 0;
    bool is_list = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("[") || line.starts_with("# [["))
            is_list = line.find("[[") != std::string::npos;
        const std::size_t equals = line.find(" = ");
        const bool is_default = line.starts_with("# ") && equals != std::string::npos && !is_list &&
                                line.find(' ', 2) == equals && line.find("…") == std::string::npos &&
                                !line.starts_with("# include");
        count += is_default;
        changed += (is_default ? line.substr(2) : line) + "\n";
    }
    CHECK(count > 40);
    const ReadText plain(text), full(changed);
    // A key that is for another case may be refused or warned of; none is unknown, of a wrong type or range.
    for (const Finding& finding : full.diagnostics.findings()) {
        CAPTURE(finding.message);
        CHECK(finding.message.find("unknown") == std::string::npos);
        CHECK(finding.message.find("expected") == std::string::npos);
        CHECK(finding.message.find("out of range") == std::string::npos);
    }
}
