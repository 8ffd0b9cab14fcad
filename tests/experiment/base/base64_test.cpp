#include "experiment/base/base64.h"

#include <catch2/catch.hpp>

#include "experiment/base/random.h"

using namespace overt;

TEST_CASE("bytes become base64 as RFC 4648 has it", "[unit]") {
    const auto coded = [](std::string_view text) {
        return base64_of(std::as_bytes(std::span(text.data(), text.size())));
    };
    CHECK(coded("").empty());
    CHECK(coded("f") == "Zg==");
    CHECK(coded("fo") == "Zm8=");
    CHECK(coded("foo") == "Zm9v");
    CHECK(coded("foobar") == "Zm9vYmFy");
}

TEST_CASE("base64 gives back the bytes it was made of, and nothing for other texts", "[unit]") {
    RandomStream random(5, "bytes");
    for (std::size_t size = 0; size < 200; ++size) {
        std::vector<std::byte> bytes(size);
        for (std::byte& byte : bytes)
            byte = static_cast<std::byte>(random.uniform(0.0, 256.0));
        const auto back = bytes_of_base64(base64_of(bytes));
        REQUIRE(back);
        CHECK(*back == bytes);
    }
    for (const std::string_view text :
         {"Z", "Zg=", "Zg==Zg==", "Zh==", "Zm9=", "Zm9v\n", "Z===", "====", "Zm 9", "Zm-_"}) {
        INFO(text);
        CHECK(!bytes_of_base64(text));
    }
}
