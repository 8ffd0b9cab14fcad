/// Which labels of observers probably mean one person.
#pragma once

#include <cctype>
#include <string>
#include <string_view>

namespace overt {

/// The label in lower case, without zeros before a number: "P07", "p7" and "P007" have one likeness, as "1"
/// and "01" have.
inline std::string likeness_of_observer(std::string_view label) {
    std::string likeness;
    const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
    for (std::size_t i = 0; i < label.size(); ++i) {
        const bool begins_a_number = is_digit(label[i]) && (i == 0 || !is_digit(label[i - 1]));
        if (begins_a_number)
            while (label[i] == '0' && i + 1 < label.size() && is_digit(label[i + 1]))
                ++i;
        likeness += static_cast<char>(std::tolower(static_cast<unsigned char>(label[i])));
    }
    return likeness;
}

/// Whether two labels differ in case or in such zeros only. Labels are taken as they are: these are two
/// observers, and somebody has to say whether that is meant.
inline bool are_alike(std::string_view a, std::string_view b) {
    return a != b && likeness_of_observer(a) == likeness_of_observer(b);
}

} // namespace overt
