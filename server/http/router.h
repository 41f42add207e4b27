// Which handler answers which method and path.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/message.h"

namespace coppice {

// May throw anything: what is an Error becomes its problem, all else internal. Headers that were set on the
// response before stay on the problem's answer.
using Handler = std::function<void(Request&, Response&)>;

struct Route {
    std::string method;
    std::string pattern;  // "/v1/jobs/{id}/result": {name} takes one segment, which is not empty
    Handler handler;
    bool always = false;         // answered even where connections are over their limit: health
    bool takes_options = false;  // reads the query; any other refuses one
};

class Router {
  public:
    void add(Route route);

    // HEAD finds what GET would. Fills the path parameters. Throws route_not_found; method_not_allowed, after
    // setting the header Allow.
    const Route& find(Request& request, Response& response) const;

    const std::vector<Route>& routes() const { return routes_; }

  private:
    std::vector<Route> routes_;
};

}  // namespace coppice
