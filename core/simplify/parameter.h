// Parameters of algorithms, as data: one description serves parsing, help, /v1/algorithms and the OpenAPI
// schema.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace coppice {

using ParameterValue = std::variant<bool, double, std::string>;

struct Parameter {
    enum class Kind {
        boolean,
        number,
        integer,
        choice,
        length,  // a number of mean edges, or text like "0.01u": in mesh units
        text,    // what `pattern` matches
    };

    std::string_view id;
    std::string_view title;  // what it means, one sentence
    Kind kind = Kind::number;
    std::string_view unit = {};                        // "mesh units", "mean edges", "degrees"; empty: none
    std::optional<ParameterValue> default_value = {};  // none: unset unless given
    std::optional<double> minimum = {};
    std::optional<double> maximum = {};
    bool minimum_excluded = false;
    std::span<const std::string_view> choices = {};
    std::string_view pattern = {};  // of a text: an ECMAScript expression for all of it, without ^ and $
    std::string_view form = {};     // of a text: what the pattern asks for, in words
    // Of a choice: the value at which an algorithm runs as its paper prints it, without any guard of the
    // surface.
    std::string_view unguarded_choice = {};
    bool ends_run = false;  // given, it is a target of its own: no default ratio then
};

// A distance in the mesh: its own units, or multiples of its mean edge.
struct Length {
    double value = 0;
    bool in_mesh_units = false;

    double in(double mean_edge) const { return in_mesh_units ? value : value * mean_edge; }
};

// Parsed values, by id. Only values that were given or have a default.
class ParameterValues {
  public:
    // Checks ids, kinds and ranges of what was given and fills in defaults. Throws option_unknown and
    // option_invalid; the message names the parameter, the value and what it takes. Text values are parsed
    // ("0.5", "true").
    static ParameterValues parse(std::span<const Parameter> parameters,
                                 const std::map<std::string, ParameterValue>& given);

    std::optional<double> number(std::string_view id) const;
    bool boolean(std::string_view id) const;           // false when unset
    std::string_view text(std::string_view id) const;  // or the choice; empty when unset
    std::optional<Length> length(std::string_view id) const;
    const std::map<std::string, ParameterValue, std::less<>>& all() const { return values_; }

  private:
    std::map<std::string, ParameterValue, std::less<>> values_;
};

}  // namespace coppice
