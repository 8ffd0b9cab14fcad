#include "experiment/record/asc/recording_date.h"

#include <array>
#include <charconv>
#include <chrono>

#include <fmt/format.h>

#include "experiment/record/asc/asc_words.h"

namespace overt {
namespace {

constexpr std::array<std::string_view, 12> months{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                  "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
constexpr std::array<std::string_view, 7> days{"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};

std::optional<int> whole(std::string_view digits) {
    int number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return error == std::errc() && end == digits.data() + digits.size() ? std::optional(number)
                                                                        : std::nullopt;
}

} // namespace

std::string asc_date(std::string_view iso) {
    namespace chrono = std::chrono;
    chrono::year_month_day date{chrono::year(1970), chrono::January, chrono::day(1)};
    std::string_view time = "00:00:00";
    if (iso.size() >= 19) {
        const auto year = whole(iso.substr(0, 4)), month = whole(iso.substr(5, 2)),
                   day = whole(iso.substr(8, 2));
        if (year && month && day && *month > 0 && *day > 0) {
            const chrono::year_month_day read{chrono::year(*year),
                                              chrono::month(static_cast<unsigned>(*month)),
                                              chrono::day(static_cast<unsigned>(*day))};
            if (read.ok()) {
                date = read;
                time = iso.substr(11, 8);
            }
        }
    }
    const chrono::weekday weekday{chrono::sys_days(date)};
    return fmt::format("{} {} {:>2} {} {}", days[weekday.c_encoding()],
                       months[static_cast<unsigned>(date.month()) - 1], static_cast<unsigned>(date.day()),
                       time, static_cast<int>(date.year()));
}

std::optional<std::string> iso_date(std::string_view asc) {
    Words words(asc);
    words.next();
    const std::string_view month_name = words.next();
    const auto day = whole(words.next());
    const std::string_view time = words.next();
    const auto year = whole(words.next());
    for (std::size_t month = 0; month < months.size(); ++month)
        if (months[month] == month_name && day && year && time.size() == 8 && *day > 0 && *day < 32 &&
            *year > 1900 && *year < 3000)
            return fmt::format("{:04}-{:02}-{:02}T{}Z", *year, month + 1, *day, time);
    return std::nullopt;
}

} // namespace overt
