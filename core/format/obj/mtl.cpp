#include "core/format/obj/mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/ascii.h"
#include "core/format/line_reader.h"

namespace coppice {

namespace {

// Options of a map statement and how many values they take at least and at most.
struct MapOption {
    std::string_view name;
    int least, most;
};
constexpr std::array map_options = {
    MapOption{"-blendu", 1, 1}, MapOption{"-blendv", 1, 1},     MapOption{"-boost", 1, 1},
    MapOption{"-mm", 2, 2},     MapOption{"-o", 1, 3},          MapOption{"-s", 1, 3},
    MapOption{"-t", 1, 3},      MapOption{"-texres", 1, 1},     MapOption{"-clamp", 1, 1},
    MapOption{"-bm", 1, 1},     MapOption{"-imfchan", 1, 1},    MapOption{"-type", 1, 1},
    MapOption{"-cc", 1, 1},     MapOption{"-colorspace", 1, 1},
};

bool looks_like_number(std::string_view word) {
    return !word.empty() && word.find_first_not_of("+-.0123456789eE") == word.npos;
}

std::string_view next_word(std::string_view& text) {
    const size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
    const size_t end = std::min(text.find_first_of(" \t", begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    text.remove_prefix(std::min(text.find_first_not_of(" \t", end), text.size()));
    return word;
}

// The file name of a map statement: what is left after the options that may stand before it or behind. Names
// may hold blanks.
std::string map_path(std::string_view text) {
    for (;;) {
        std::string_view after = text;
        const std::string_view word = next_word(after);
        const auto option = std::find_if(map_options.begin(), map_options.end(),
                                         [&](const MapOption& o) { return o.name == word; });
        if (option == map_options.end()) break;
        for (int i = 0; i < option->most; ++i) {
            std::string_view after_value = after;
            const std::string_view value = next_word(after_value);
            if (after_value.empty() || (i >= option->least && !looks_like_number(value))) break;
            after = after_value;
        }
        text = after;
    }
    const size_t behind = text.rfind(" -bm ");
    return std::string(text.substr(0, behind));
}

class MtlParser {
  public:
    MtlParser(std::string_view library, WarningTally& tally) : library_(library), tally_(tally) {}

    std::vector<MtlMaterial> parse(std::string_view text) {
        LineReader reader(text, true);
        Line line;
        while (reader.next(line)) {
            try {
                statement(line);
            } catch (const Error& error) {
                tally_.note(
                    "mtl.malformed",
                    "a statement of a material library does not parse and was skipped: " + error.message(),
                    fmt::format("{}, {}", library_, error.where()));
            }
        }
        finish();
        return std::move(materials_);
    }

  private:
    void statement(Line& line) {
        const std::string word = lower(line.word());
        if (word.empty() || word.front() == '#') return;
        if (word == "newmtl") return begin(line.rest());
        if (materials_.empty()) return;
        if (word.starts_with("map_") || word == "norm" || word == "bump" || word == "disp" ||
            word == "decal" || word == "refl") {
            return map(word, line.rest());
        }
        value(word, line);
    }

    void begin(std::string_view name) {
        finish();
        materials_.emplace_back().material.name = std::string(name);
    }

    void value(std::string_view word, Line& line) {
        Material& m = materials_.back().material;
        if (word == "kd") return color(line, m.base_color[0], m.base_color[1], m.base_color[2]);
        if (word == "ke") return color(line, m.emissive[0], m.emissive[1], m.emissive[2]);
        if (word == "d") {
            if (line.peek(), line.done()) return;
            if (line.text().find("-halo") == line.text().npos) alpha_ = fraction(line);
        }
        if (word == "tr") transparency_ = fraction(line);
        if (word == "pr") roughness_ = fraction(line);
        if (word == "pm") m.metallic = fraction(line);
        if (word == "ns") shininess_ = static_cast<float>(line.number("Ns"));
    }

    static float fraction(Line& line) {
        const double value = line.number("a value from 0 to 1");
        return std::isfinite(value) ? static_cast<float>(std::clamp(value, 0.0, 1.0)) : 0.0F;
    }

    // r [g b]; one number is grey. "xyz" and "spectral" are not read.
    static void color(Line& line, float& red, float& green, float& blue) {
        red = fraction(line);
        green = line.ended() ? red : fraction(line);
        blue = line.ended() ? red : fraction(line);
    }

    void map(std::string_view word, std::string_view text) {
        const std::string path = map_path(text);
        if (path.empty()) return;
        MtlMaterial& m = materials_.back();
        m.paths.push_back(path);
        if (word == "map_kd") m.base_color_path = path;
        if (word == "map_ke") m.emissive_path = path;
        if (word == "norm") m.normal_path = path;
        if ((word == "map_bump" || word == "bump") && m.normal_path.empty()) m.normal_path = path;
        if (word == "map_d") alpha_path_ = path;
    }

    // What depends on several statements, whatever their order.
    void finish() {
        if (materials_.empty()) return;
        MtlMaterial& m = materials_.back();
        std::array<float, 4>& color = m.material.base_color;
        color[3] = alpha_ ? *alpha_ : 1 - transparency_.value_or(0);
        // Exporters write Kd 0 0 0 beside a map and mean the map alone.
        if (!m.base_color_path.empty() && color[0] == 0 && color[1] == 0 && color[2] == 0)
            color = {1, 1, 1, color[3]};
        if (!m.emissive_path.empty() && m.material.emissive == std::array<float, 3>{0, 0, 0}) {
            m.material.emissive = {1, 1, 1};
        }
        const bool alpha_in_map = !alpha_path_.empty() && alpha_path_ == m.base_color_path;
        if (color[3] < 1 || alpha_in_map) m.material.alpha = Material::Alpha::blend;
        // A Phong exponent and a roughness of equal highlights (Walter et al. 2007).
        if (shininess_ && *shininess_ >= 0)
            m.material.roughness = std::min(1.0F, std::sqrt(2 / (*shininess_ + 2)));
        if (roughness_) m.material.roughness = *roughness_;
        alpha_ = transparency_ = roughness_ = shininess_ = std::nullopt;
        alpha_path_.clear();
    }

    std::string_view library_;
    WarningTally& tally_;
    std::vector<MtlMaterial> materials_;
    std::optional<float> alpha_, transparency_, roughness_, shininess_;
    std::string alpha_path_;
};

void print_map(std::string& out, std::string_view statement, const TextureUse& use,
               std::span<const std::string> image_paths) {
    if (use.image) fmt::format_to(std::back_inserter(out), "{} {}\n", statement, image_paths[*use.image]);
}

}  // namespace

std::vector<MtlMaterial> parse_mtl(std::string_view text, std::string_view library, WarningTally& tally) {
    return MtlParser(library, tally).parse(text);
}

std::string print_mtl(std::span<const Material> materials, std::span<const std::string> names,
                      std::span<const std::string> image_paths) {
    std::string out;
    for (size_t i = 0; i < materials.size(); ++i) {
        const Material& m = materials[i];
        const auto& c = m.base_color;
        fmt::format_to(std::back_inserter(out), "newmtl {}\nKd {} {} {}\nd {}\nPr {}\nPm {}\n", names[i],
                       c[0], c[1], c[2], m.alpha == Material::Alpha::opaque ? 1.0F : c[3], m.roughness,
                       m.metallic);
        if (m.emissive != std::array<float, 3>{0, 0, 0}) {
            fmt::format_to(std::back_inserter(out), "Ke {} {} {}\n", m.emissive[0], m.emissive[1],
                           m.emissive[2]);
        }
        print_map(out, "map_Kd", m.base_color_texture, image_paths);
        if (m.alpha != Material::Alpha::opaque) print_map(out, "map_d", m.base_color_texture, image_paths);
        print_map(out, "map_Ke", m.emissive_texture, image_paths);
        print_map(out, "norm", m.normal_texture, image_paths);
    }
    return out;
}

}  // namespace coppice
