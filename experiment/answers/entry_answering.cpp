#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "experiment/answers/answer_kinds.h"
#include "experiment/base/text_number.h"
#include "experiment/base/utf8_text.h"

namespace overt {

namespace {

/// What is typed, at its end.
class EntryAnswering : public Answering {
  public:
    EntryAnswering(const AnswerForm& form, int longest) : Answering(form), longest_(longest) {
        constexpr std::size_t bytes_of_a_character = 4;
        typed_.reserve(bytes_of_a_character * static_cast<std::size_t>(longest) + 1);
    }

    Effect take(const ObserverInput& input, const AnswerPlace&) noexcept override {
        using Kind = ObserverInput::Kind;
        if ((input.kind == Kind::key_down && input.key.view() == "backspace") ||
            (input.kind == Kind::text && input.character == U'\b'))
            return erase();
        if (input.kind != Kind::text || !takes(input.character) || count_ >= longest_)
            return Effect::none;
        append_utf8(typed_, input.character);
        ++count_;
        return Effect::changed;
    }
    bool has_value() const noexcept override { return typed_.find_first_not_of(" \n") != std::string::npos; }
    std::string value() const override {
        const std::size_t begin = typed_.find_first_not_of(" \n");
        return typed_.substr(begin, typed_.find_last_not_of(" \n") + 1 - begin);
    }
    void draw(AnswerItem& item) const override {
        item.typed = typed_;
        item.caret = typed_.size();
        item.unit = settings().unit;
    }

    void offer(AnswerOffer& offer) const override {
        offer.low = settings().min;
        offer.high = settings().max;
        offer.step = settings().step.value_or(0.0);
    }

  protected:
    virtual bool takes(char32_t character) const noexcept { return character >= U' ' && character != 0x7F; }
    const std::string& typed() const noexcept { return typed_; }

  private:
    Effect erase() noexcept {
        if (typed_.empty())
            return Effect::none;
        constexpr unsigned char continues = 0x80, mask = 0xC0;
        while (!typed_.empty() && (static_cast<unsigned char>(typed_.back()) & mask) == continues)
            typed_.pop_back();
        if (!typed_.empty())
            typed_.pop_back();
        --count_;
        return Effect::changed;
    }

    int longest_;
    int count_ = 0; ///< characters
    std::string typed_;
};

class TextAnswering final : public EntryAnswering {
  public:
    explicit TextAnswering(const AnswerForm& form) : EntryAnswering(form, form.settings->longest) {}
    void draw(AnswerItem& item) const override {
        EntryAnswering::draw(item);
        item.kind = AnswerItem::Kind::text;
    }
};

/// A comma is a decimal point, too.
class NumberAnswering final : public EntryAnswering {
  public:
    explicit NumberAnswering(const AnswerForm& form) : EntryAnswering(form, longest_number) {}

    bool has_value() const noexcept override { return !typed().empty(); }
    std::string value() const override {
        const std::optional<double> is = number();
        return is ? fmt::format("{:.15g}", *is) : typed();
    }
    std::optional<double> number() const noexcept override {
        std::array<char, longest_number> plain{};
        std::ranges::replace_copy(typed(), plain.begin(), ',', '.');
        return number_in<double>(std::string_view(plain.data(), typed().size()));
    }
    bool is_sound() const noexcept override {
        const std::optional<double> is = number();
        if (!is || !std::isfinite(*is) || (settings().min && *is < *settings().min) ||
            (settings().max && *is > *settings().max))
            return false;
        if (!settings().step)
            return true;
        const double steps = (*is - settings().min.value_or(0.0)) / *settings().step;
        return std::abs(steps - std::round(steps)) <= 1e-6;
    }
    void draw(AnswerItem& item) const override {
        EntryAnswering::draw(item);
        item.kind = AnswerItem::Kind::number;
        if (has_value() && !is_sound())
            item.message = allowed();
    }

  private:
    /// "0 … 100" in figures alone, which need no language.
    std::string allowed() const {
        const auto end = [](const std::optional<double>& of) {
            return of ? fmt::format("{:g}", *of) : std::string();
        };
        std::string text = fmt::format("{} … {}", end(settings().min), end(settings().max));
        if (settings().step)
            text += fmt::format(" (± {:g})", *settings().step);
        return text;
    }

    static constexpr int longest_number = 18;
    bool takes(char32_t character) const noexcept override {
        return (character >= U'0' && character <= U'9') || character == U'.' || character == U',' ||
               (character == U'-' && typed().empty());
    }
};

} // namespace

std::unique_ptr<Answering> number_answering(const AnswerForm& form) {
    return std::make_unique<NumberAnswering>(form);
}

std::unique_ptr<Answering> text_answering(const AnswerForm& form) {
    return std::make_unique<TextAnswering>(form);
}

} // namespace overt
