#include "experiment/record/asc/asc_files.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/content_hash.h"
#include "experiment/base/error.h"
#include "experiment/record/asc/asc_words.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

/// What files begin with that are no text in ASCII or UTF-8, with what they are and how they become such.
struct ForeignBeginning {
    std::string_view bytes, what, remedy;
};
constexpr std::array foreign_beginnings{
    ForeignBeginning{"SR_RESEARCH"sv, "a binary recording of an EyeLink (EDF)",
                     "Make its text form with SR Research's edf2asc, and import that: edf2asc {}"},
    ForeignBeginning{"\xff\xfe\0\0"sv, "text in UTF-32",
                     "Convert it: iconv -f UTF-32 -t UTF-8 {} > utf8.asc"},
    ForeignBeginning{"\xff\xfe"sv, "text in UTF-16", "Convert it: iconv -f UTF-16 -t UTF-8 {} > utf8.asc"},
    ForeignBeginning{"\xfe\xff"sv, "text in UTF-16", "Convert it: iconv -f UTF-16 -t UTF-8 {} > utf8.asc"},
    ForeignBeginning{"\x1f\x8b"sv, "compressed with gzip", "Unpack it: gzip -dc {} > unpacked.asc"},
    ForeignBeginning{"BZh"sv, "compressed with bzip2", "Unpack it: bzip2 -dc {} > unpacked.asc"},
    ForeignBeginning{"\3757zXZ"sv, "compressed with xz", "Unpack it: xz -dc {} > unpacked.asc"},
    ForeignBeginning{"\x28\xb5\x2f\xfd"sv, "compressed with zstd", "Unpack it: zstd -dc {} > unpacked.asc"},
    ForeignBeginning{"PK\x03\x04"sv, "a ZIP archive", "Unpack it: unzip {}"},
    ForeignBeginning{"7z\xbc\xaf"sv, "a 7z archive", "Unpack it: 7z x {}"},
};

/// Text in UTF-16 without a mark has a zero in every other byte.
bool is_wide_text(std::string_view begin) {
    constexpr std::size_t looked_at = 256;
    begin = begin.substr(0, looked_at);
    std::size_t zeros[2] = {0, 0};
    for (std::size_t i = 0; i < begin.size(); ++i)
        zeros[i % 2] += begin[i] == '\0';
    const auto [least, most] = std::minmax(zeros[0], zeros[1]);
    return begin.size() >= 8 && least == 0 && 4 * most > begin.size();
}

/// Throws InputError if a file begins with what no text form of a recording does.
void refuse_foreign(const fs::path& file, std::string_view begin) {
    const std::string name = file.filename().string();
    for (const ForeignBeginning& foreign : foreign_beginnings)
        if (begin.starts_with(foreign.bytes))
            throw InputError(fmt::format("{}: is {}. {}", file.string(), foreign.what,
                                         fmt::format(fmt::runtime(foreign.remedy), name)));
    if (is_wide_text(begin))
        throw InputError(fmt::format("{}: is text in UTF-16. Convert it: iconv -f UTF-16{} -t UTF-8 {} > "
                                     "utf8.asc",
                                     file.string(), begin.front() == '\0' ? "BE" : "LE", name));
    std::string_view first = begin.substr(0, begin.find('\n'));
    if (first.size() < begin.size() && first.ends_with('\r'))
        first.remove_suffix(1); // as on Windows
    if (std::count(first.begin(), first.end(), '\r') > 1)
        throw InputError(fmt::format("{0}: its lines end with a carriage return alone (CR), as on old "
                                     "Macintoshes. Convert it: tr '\\r' '\\n' < {1} > lines.asc",
                                     file.string(), name));
}

/// Gives a file's lines one after another.
class AscLines {
  public:
    explicit AscLines(const fs::path& file);

    /// The next line, valid until the next call; nothing at the end. Throws InputError.
    std::optional<std::string_view> next();
    std::int64_t number() const { return number_; } ///< of the line given last, from 1
    std::int64_t read() const { return read_; }     ///< bytes
    std::int64_t all() const { return all_; }

  private:
    bool fill();

    fs::path file_;
    std::int64_t all_ = 0, read_ = 0, number_ = 0;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_;
    std::vector<char> piece_;
    std::string_view rest_; ///< of the piece
    std::string line_;      ///< that runs over pieces
};

AscLines::AscLines(const fs::path& file)
    : file_(file), stream_(nullptr, &std::fclose), piece_(std::size_t{1} << 20) {
    std::error_code error;
    all_ = static_cast<std::int64_t>(fs::file_size(file, error));
    if (!error && fs::is_regular_file(file))
        stream_.reset(std::fopen(file.c_str(), "rb"));
    if (!stream_)
        throw InputError(
            fmt::format("{}: this file cannot be read. Give the path of a recording in EyeLink's "
                        "text form (.asc).",
                        file.string()));
    fill();
    refuse_foreign(file, rest_);
    if (rest_.starts_with(byte_order_mark))
        rest_.remove_prefix(byte_order_mark.size());
}

bool AscLines::fill() {
    const std::size_t count = std::fread(piece_.data(), 1, piece_.size(), stream_.get());
    if (std::ferror(stream_.get()) != 0)
        throw InputError(fmt::format("{}: reading failed after {} bytes.", file_.string(), read_));
    read_ += static_cast<std::int64_t>(count);
    rest_ = std::string_view(piece_.data(), count);
    return count > 0;
}

std::optional<std::string_view> AscLines::next() {
    line_.clear();
    bool runs_over = false;
    while (!rest_.empty() || fill()) {
        const std::size_t end = rest_.find('\n');
        if (end != std::string_view::npos) {
            const std::string_view last = rest_.substr(0, end);
            rest_.remove_prefix(end + 1);
            ++number_;
            if (!runs_over)
                return last;
            line_ += last;
            return line_;
        }
        // Of a line that is too long anyway not all needs to be kept.
        line_.append(rest_.substr(0, std::min(rest_.size(), 2 * longest_asc_line)));
        line_.resize(std::min(line_.size(), 4 * longest_asc_line));
        runs_over = true;
        rest_ = {};
    }
    if (line_.empty())
        return std::nullopt;
    ++number_;
    return line_;
}

bool is_sample(std::string_view line) { return !line.empty() && is_digit(line.front()); }

bool has_samples(const fs::path& file) {
    AscLines lines(file);
    while (const auto line = lines.next())
        if (is_sample(*line))
            return true;
    return false;
}

/// Where a line without samples stands among samples: before or after those of its millisecond, or, if it has
/// no time, right after the line before it.
struct LinePlace {
    std::int64_t us = 0;
    bool is_after = false;
    auto operator<=>(const LinePlace&) const = default;
};

std::optional<LinePlace> place_of_line(std::string_view line) {
    Words words(line);
    const std::string_view word = words.next();
    const bool ends = word == "EFIX" || word == "ESACC" || word == "EBLINK";
    if (ends || word == "SFIX" || word == "SSACC" || word == "SBLINK")
        words.next(); // the eye
    else if (word != "MSG" && word != "START" && word != "END" && word != "BUTTON" && word != "INPUT")
        return std::nullopt;
    if (ends)
        words.next(); // its begin
    const std::optional<std::int64_t> us = asc_time_us(words.next());
    return us ? std::optional(LinePlace{*us, ends || word == "END"}) : std::nullopt;
}

/// Two of a recording: the lines of `others` with `samples` between them.
class MergedLines {
  public:
    MergedLines(AscLines& others, AscLines& samples) : others_(others), samples_(samples) {
        take_other();
        take_sample();
    }

    bool give(AscParser& parser) {
        if (!other_ && !sample_)
            return false;
        if (other_ && (!sample_ || other_place_ < LinePlace{sample_us_, true})) {
            parser.line(*other_, others_.number());
            take_other();
        } else {
            parser.line(*sample_, samples_.number());
            take_sample();
        }
        return true;
    }

  private:
    void take_other() {
        do
            other_ = others_.next();
        while (other_ && is_sample(*other_));
        // Lines stay in their order, whatever their times.
        if (const auto place = other_ ? place_of_line(*other_) : std::nullopt)
            other_place_ = std::max(other_place_, *place);
    }
    void take_sample() {
        do
            sample_ = samples_.next();
        while (sample_ && !is_sample(*sample_));
        if (sample_)
            sample_us_ = asc_time_us(Words(*sample_).next()).value_or(sample_us_);
    }

    AscLines &others_, &samples_;
    std::optional<std::string_view> other_, sample_;
    LinePlace other_place_;
    std::int64_t sample_us_ = 0;
};

} // namespace

AscFiles::AscFiles(const fs::path& one, const fs::path& other) {
    const bool first = has_samples(one), second = has_samples(other);
    if (first == second)
        throw InputError(fmt::format(
            "{} and {}: {}. Two files are one recording if one of them has its samples (edf2asc -s) and the "
            "other its events and messages (edf2asc -e); import others one by one.",
            one.string(), other.string(), first ? "both have samples" : "neither has samples"));
    samples_ = first ? one : other;
    events_ = first ? other : one;
}

std::string AscFiles::path() const {
    return are_two() ? events_.string() + " and " + samples_.string() : events_.string();
}

std::string AscFiles::name() const {
    return are_two() ? events_.filename().string() + " and " + samples_.filename().string()
                     : events_.filename().string();
}

std::string AscFiles::hashes() const {
    return are_two() ? hash_of_file(events_) + " " + hash_of_file(samples_) : hash_of_file(events_);
}

const fs::path& AscFiles::of_line(std::string_view line) const {
    return are_two() && is_sample(line) ? samples_ : events_;
}

void AscFiles::read_lines(const std::function<void(std::string_view)>& take,
                          const std::function<void(std::int64_t, std::int64_t)>& progress) const {
    std::vector<fs::path> files{events_};
    if (are_two())
        files.push_back(samples_);
    std::int64_t all = 0, before = 0, told = -1;
    for (const fs::path& file : files)
        all += AscLines(file).all();
    for (const fs::path& file : files) {
        AscLines lines(file);
        while (const std::optional<std::string_view> line = lines.next()) {
            take(*line);
            const std::int64_t done = before + lines.read();
            if (progress && done != std::exchange(told, done))
                progress(done, all);
        }
        before += lines.all();
    }
}

void AscFiles::parse(AscParser& parser,
                     const std::function<void(std::int64_t, std::int64_t)>& progress) const {
    AscLines lines(events_);
    std::optional<AscLines> samples;
    std::optional<MergedLines> merged;
    if (are_two()) {
        samples.emplace(samples_);
        merged.emplace(lines, *samples);
    }
    const std::int64_t all = lines.all() + (samples ? samples->all() : 0);
    std::int64_t told = -1;
    const auto give = [&] {
        if (merged)
            return merged->give(parser);
        const std::optional<std::string_view> line = lines.next();
        if (line)
            parser.line(*line, lines.number());
        return line.has_value();
    };
    while (give()) {
        const std::int64_t done = lines.read() + (samples ? samples->read() : 0);
        if (progress && done != std::exchange(told, done))
            progress(done, all);
    }
    parser.end();
}

} // namespace overt
