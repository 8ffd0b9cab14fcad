#include "app/display/patch_photometers.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

#include <fmt/format.h>

#include "devices/link/serial_port.h"
#include "experiment/base/error.h"

namespace overt {

namespace {

class ColorCalPhotometer final : public PatchPhotometer {
  public:
    ColorCalPhotometer(const std::optional<std::string>& port, Clock& clock)
        : device_(find_colorcal(serial_ports(), port, serial_port_opener(clock), clock)) {
        if (device_->forgets_dark_level())
            calibrate_dark();
    }
    std::string description() const override {
        const ColorCalIdentity& identity = device_->identity();
        return fmt::format("ColorCAL MkII, serial {}, firmware {}", identity.serial_number,
                           identity.firmware);
    }
    std::optional<glm::dvec3> measure(const ShownPatch&) override { return device_->measure_xyz(); }

  private:
    void calibrate_dark() {
        std::string line;
        for (int attempt = 0;; ++attempt) {
            fmt::print(stderr, "This photometer forgets its dark level: cover its lens and press Enter. ");
            if (!std::getline(std::cin, line))
                throw DeviceError("the photometer's lens was not covered: start again at a terminal.");
            try {
                device_->calibrate_dark();
                break;
            } catch (const DeviceError& error) {
                if (attempt == 2)
                    throw;
                fmt::print(stderr, "{}\n", error.what());
            }
        }
        fmt::print(stderr, "Now put it on the middle of the screen and press Enter. ");
        std::getline(std::cin, line);
    }
    std::unique_ptr<ColorCal> device_;
};

class TypedPhotometer final : public PatchPhotometer {
  public:
    explicit TypedPhotometer(std::string instrument) : instrument_(std::move(instrument)) {}
    std::string description() const override { return instrument_; }
    std::optional<glm::dvec3> measure(const ShownPatch& patch) override {
        std::string line;
        while (true) {
            fmt::print(stderr,
                       "patch {} of {}, signal {:.4f} {:.4f} {:.4f}: X Y Z in cd/m2 (or xyY x y Y; q ends) ",
                       patch.number, patch.count, patch.signal.x, patch.signal.y, patch.signal.z);
            if (!std::getline(std::cin, line) || line == "q") {
                fmt::print(stderr, "\n");
                return std::nullopt;
            }
            if (const auto xyz = typed_xyz(line))
                return xyz;
            fmt::print(stderr, "three numbers that are not below 0, please, such as: 41.2 43.5 46.1\n");
        }
    }

  private:
    std::string instrument_;
};

class Simulation final : public PatchPhotometer {
  public:
    Simulation(const DisplayTruth& truth, std::uint64_t seed) : seed_(seed), photometer_(truth, seed) {}
    std::string description() const override {
        return fmt::format("a simulated photometer before a simulated display, seed {}", seed_);
    }
    std::optional<glm::dvec3> measure(const ShownPatch& patch) override {
        return photometer_.measure_xyz(patch.signal);
    }

  private:
    std::uint64_t seed_;
    SimulatedPhotometer photometer_;
};

} // namespace

std::unique_ptr<PatchPhotometer> make_colorcal_photometer(const std::optional<std::string>& port,
                                                          Clock& clock) {
    return std::make_unique<ColorCalPhotometer>(port, clock);
}

std::unique_ptr<PatchPhotometer> make_typed_photometer(std::string instrument) {
    return std::make_unique<TypedPhotometer>(std::move(instrument));
}

std::unique_ptr<PatchPhotometer> make_simulated_photometer(const DisplayTruth& truth, std::uint64_t seed) {
    return std::make_unique<Simulation>(truth, seed);
}

std::optional<glm::dvec3> typed_xyz(const std::string& line) {
    std::string spaced = line;
    std::replace(spaced.begin(), spaced.end(), ',', ' ');
    std::istringstream words(spaced);
    words.imbue(std::locale::classic());
    const bool is_xyy = words.str().find("xyY") != std::string::npos;
    std::string word;
    if (is_xyy && (!(words >> word) || word != "xyY"))
        return std::nullopt;
    glm::dvec3 numbers(0.0);
    if (!(words >> numbers.x >> numbers.y >> numbers.z) || words >> word)
        return std::nullopt;
    for (int i = 0; i < 3; ++i) {
        if (!std::isfinite(numbers[i]) || numbers[i] < 0.0)
            return std::nullopt;
    }
    if (!is_xyy)
        return numbers;
    if (!(numbers.y > 0.0) || numbers.x + numbers.y > 1.0)
        return std::nullopt;
    const double scale = numbers.z / numbers.y;
    return glm::dvec3(numbers.x * scale, numbers.z, (1.0 - numbers.x - numbers.y) * scale);
}

} // namespace overt
