/// MessagePack, read value by value from memory: https://github.com/msgpack/msgpack/blob/master/spec.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace overt {

/// Goes through bytes that somebody else wrote. Values are taken one after the other; one of another kind
/// than is asked for is passed over, with all that is in it, and gives nothing. Where the bytes end too soon
/// or are no MessagePack it has failed and gives nothing any more. Nothing allocates, throws or recurses,
/// however deep the values are nested (nlohmann::json::from_msgpack runs out of stack at a million arrays in
/// each other). Texts point into the bytes.
class MsgpackReader {
  public:
    explicit MsgpackReader(std::string_view bytes) noexcept : rest_(bytes) {}

    bool failed() const noexcept { return failed_; }

    /// A whole number or one in floating point.
    std::optional<double> number() noexcept;
    std::optional<std::string_view> text() noexcept;
    std::optional<bool> boolean() noexcept;
    /// The number of elements, or of pairs of key and value, which follow.
    std::optional<std::uint32_t> begin_array() noexcept;
    std::optional<std::uint32_t> begin_map() noexcept;
    void skip() noexcept;

    /// Of a map: calls on_value(key) for each pair with the reader at the value; true: it took the value,
    /// else the value is passed over. False if what comes is no whole map with texts as keys.
    template <class OnValue> bool each_entry(OnValue&& on_value) noexcept;

  private:
    enum class Kind : std::uint8_t { nothing, nil, boolean, number, text, binary, array, map, extension };
    /// The head of a value; of texts, bytes and extensions with their content.
    struct Head {
        Kind kind = Kind::nothing;
        double number = 0.0;     ///< of a number; of a boolean 0 or 1
        std::uint32_t count = 0; ///< of elements or pairs
        std::string_view content = {};
    };
    Head next() noexcept;
    Head head_of(std::uint8_t byte) noexcept;
    std::uint64_t big_endian(int bytes) noexcept;
    Head content(Kind kind, std::uint64_t length) noexcept;
    void pass_over(const Head& head) noexcept;
    /// The next value's `part` if it is of this kind.
    template <class Value> std::optional<Value> next_of(Kind kind, Value Head::*part) noexcept;

    std::string_view rest_;
    bool failed_ = false;
};

template <class OnValue> bool MsgpackReader::each_entry(OnValue&& on_value) noexcept {
    const std::optional<std::uint32_t> pairs = begin_map();
    for (std::uint32_t i = 0; pairs && i < *pairs && !failed_; ++i) {
        const std::optional<std::string_view> key = text();
        if (!key || !on_value(*key))
            skip();
    }
    return pairs && !failed_;
}

} // namespace overt
