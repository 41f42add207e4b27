#include "server/http/router.h"

#include <algorithm>
#include <optional>

#include "core/base/error.h"

namespace coppice {
namespace {

using Parameters = std::map<std::string, std::string, std::less<>>;

std::string_view take_segment(std::string_view& path) {
    const auto segment = path.substr(0, path.find('/'));
    path.remove_prefix(std::min(segment.size() + 1, path.size()));
    return segment;
}

std::optional<Parameters> match(std::string_view pattern, std::string_view path) {
    if (std::count(pattern.begin(), pattern.end(), '/') != std::count(path.begin(), path.end(), '/'))
        return {};
    Parameters parameters;
    while (!pattern.empty() || !path.empty()) {
        const auto wanted = take_segment(pattern);
        const auto given = take_segment(path);
        if (wanted.starts_with('{') && !given.empty()) {
            parameters.emplace(wanted.substr(1, wanted.size() - 2), given);
        } else if (wanted != given) {
            return {};
        }
    }
    return parameters;
}

}  // namespace

void Router::add(Route route) {
    routes_.push_back(std::move(route));
}

const Route& Router::find(Request& request, Response& response) const {
    const std::string_view method = request.method == "HEAD" ? "GET" : std::string_view(request.method);
    std::string allowed;
    for (const Route& route : routes_) {
        auto parameters = match(route.pattern, request.path);
        if (!parameters) continue;
        if (route.method == method) {
            request.path_parameters = std::move(*parameters);
            return route;
        }
        if (!allowed.empty()) allowed += ", ";
        allowed += route.method == "GET" ? "GET, HEAD" : route.method;
    }
    require(!allowed.empty(), ErrorCode::route_not_found, "",
            "there is nothing at this path; /openapi.json lists what there is");
    response.set("Allow", allowed);
    fail(ErrorCode::method_not_allowed, "",
         fmt::format("{} is not taken here; {} is", request.method, allowed));
}

}  // namespace coppice
