#include "wheelwright/web/watch/session.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "wheelwright/case/unlimited.h"
#include "wheelwright/output/page/assets.h"
#include "wheelwright/run/commands/command_json.h"
#include "wheelwright/run/observers/command_log.h"
#include "wheelwright/web/watch/board_observer.h"
#include "wheelwright/web/watch/frame.h"
#include "wheelwright/web/watch/freed_memory_observer.h"
#include "wheelwright/web/watch/products.h"

namespace wheelwright {
namespace {

using namespace std::chrono_literals;

/// How long a page waits for news before it polls again.
constexpr auto patience = 15s;

/// The longest time that a request for errors waits before it reports the time spent so far.
constexpr auto between_tellings = 1s;

/// A nonnegative integer parameter of the address; 0 if absent.
long parameter(const PageRequest& request, const std::string& name) {
  const auto found = request.parameters.find(name);
  if (found == request.parameters.end()) return 0;
  long value = 0;
  const std::string& text = found->second;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return std::max(0L, value);
}

PageAnswer message(int status, bool was_executed, const std::string& text) {
  const nlohmann::ordered_json json{{"executed", was_executed}, {"text", text}};
  return {.status = status,
          .body = json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace)};
}

/// The load case that a page requests; the first if there is no such one.
template <int dim>
int asked_load_case(const PageRequest& request, const WatchedShape<dim>& shape) {
  const long load_case = parameter(request, "case");
  return load_case < static_cast<long>(shape.solutions.size()) ? static_cast<int>(load_case) : 0;
}

PageAnswer no_shape() { return message(409, false, "there is no shape yet"); }

Route asset(Route::Access access, std::string path, std::string type, std::string_view content) {
  return {Route::Method::get, access, std::move(path), [type = std::move(type), content](const PageRequest&) {
            return PageAnswer{.type = type, .body = std::string(content)};
          }};
}

}  // namespace

Case watched_case(Case c) {
  constexpr double seconds_between_checkpoints = 5;
  c.optimizer.iterations = unlimited_iterations;
  c.output.vtu_every = 0;
  c.output.pictures_every = 0;
  c.output.checkpoint_every = 0;
  c.output.checkpoint_seconds = seconds_between_checkpoints;
  c.expectations.clear();
  return c;
}

template <int dim>
WatchSession<dim>::WatchSession(CommandQueue& commands, OfferedDesigns designs, CommandKinds kinds)
    : designs_(std::move(designs)),
      kinds_(std::move(kinds)),
      board_(std::make_shared<Board<dim>>()),
      numbers_(std::make_shared<WatchedNumbers<dim>>()),
      errors_(std::make_shared<WatchedErrors<dim>>()),
      commands_(std::make_shared<PageCommands>(commands)) {}

template <int dim>
void WatchSession<dim>::watch(Run<dim>& run) {
  folder_ = run.folder();
  run.add(std::make_unique<CommandLog<dim>>());
  run.add(std::make_unique<BoardObserver<dim>>(board_));
  run.add(std::make_unique<PageCommandsObserver<dim>>(commands_));
  run.add(std::make_unique<FreedMemoryObserver<dim>>());
}

template <int dim>
std::vector<Route> WatchSession<dim>::routes() {
  using enum Route::Method;
  using enum Route::Access;
  const std::string script = "text/javascript; charset=utf-8";
  return {asset(page, "/", "text/html; charset=utf-8", assets::watch_html),
          asset(open, "/page.css", "text/css; charset=utf-8", assets::report_css),
          asset(open, "/watch.css", "text/css; charset=utf-8", assets::watch_css),
          asset(open, "/chart.js", script, assets::chart_js),
          asset(open, "/three.js", script, assets::three_js),
          asset(open, "/formats.js", script, assets::formats_js),
          asset(open, "/parts.js", script, assets::parts_js),
          asset(open, "/stage.js", script, assets::stage_js),
          asset(open, "/watch.js", script, assets::watch_js),
          {get, token, "/frame", [this](const PageRequest& request) { return frame(request); }},
          {get, token, "/loaded", [this](const PageRequest& request) { return loaded(request); }},
          {get, token, "/numbers", [this](const PageRequest& request) { return numbers(request); }},
          {get, token, "/errors", [this](const PageRequest&) { return errors(); }},
          {post, token, "/errors", [this](const PageRequest&) { return estimate_errors(); }},
          {get, token, "/export", [this](const PageRequest& request) { return exported_file(request); }},
          {get, token, "/report", [this](const PageRequest&) { return report(); }},
          {post, token, "/save", [this](const PageRequest& request) { return save(request); }},
          {get, token, "/designs", [this](const PageRequest&) { return PageAnswer{.body = designs_.json}; }},
          {post, token, "/take", [this](const PageRequest& request) { return take(request); }},
          {post, token, "/command", [this](const PageRequest& request) { return command(request); }}};
}

template <int dim>
void WatchSession<dim>::close() {
  board_->close();
  commands_->close();
  errors_->close();
}

template <int dim>
PageAnswer WatchSession<dim>::frame(const PageRequest& request) const {
  const FrameQuery query{.position = static_cast<int>(std::min(parameter(request, "position"), 1000L)),
                         .load_case = static_cast<int>(std::min(parameter(request, "case"), 1000L)),
                         .wants_force_curve = parameter(request, "force_curve") > 0,
                         .wants_initial_outline = parameter(request, "curve") == 0};
  const BoardView<dim> view = board_->view_after(parameter(request, "after"), patience);
  return {.body = frame_json(view, board_->curve_after(parameter(request, "curve")), query)};
}

template <int dim>
PageAnswer WatchSession<dim>::command(const PageRequest& request) {
  const auto parsed = parse_command(request.body, kinds_);
  if (!parsed) return message(400, false, parsed.failure().reason);
  if (!PageCommands::is_for_pages(*parsed) || parsed->is<TakeShape>())
    return message(400, false, "not a command of a page");
  return executed(*parsed);
}

/// The shape of an offered design: a page passes its name, never a file.
template <int dim>
PageAnswer WatchSession<dim>::take(const PageRequest& request) {
  const auto found = designs_.shapes.find(request.body);
  if (found == designs_.shapes.end()) return message(422, false, "there is no such design");
  return executed(TakeShape{found->second.string()});
}

template <int dim>
PageAnswer WatchSession<dim>::executed(Command command) {
  const auto ticket = commands_->give(std::move(command));
  if (!ticket) return message(429, false, "too many commands are waiting");
  const auto answer = commands_->answer(*ticket, patience);
  if (!answer) return message(202, false, "not executed yet");
  return message(200, answer->was_executed, answer->text);
}

template <int dim>
PageAnswer WatchSession<dim>::loaded(const PageRequest& request) const {
  BoardView<dim> view = board_->view();
  if (parameter(request, "initial") > 0) view.shape = view.first;
  if (!view.shape) return no_shape();
  const int load_case = asked_load_case(request, *view.shape), n = view.shape->solver->model().n_positions,
            position = static_cast<int>(parameter(request, "position") % n);
  return {.body = loaded_json(view, load_case, position)};
}

template <int dim>
PageAnswer WatchSession<dim>::numbers(const PageRequest& request) const {
  const BoardView<dim> view = board_->view();
  if (!view.shape) return no_shape();
  return {.body = numbers_->json(view, asked_load_case(request, *view.shape))};
}

template <int dim>
PageAnswer WatchSession<dim>::errors() const {
  return {.body = errors_->json(between_tellings)};
}

template <int dim>
PageAnswer WatchSession<dim>::estimate_errors() {
  const BoardView<dim> view = board_->view();
  if (!view.shape) return no_shape();
  const auto begun = errors_->begin(view);
  if (!begun) return message(409, false, begun.failure().reason);
  return message(202, true, *begun);
}

template <int dim>
PageAnswer WatchSession<dim>::exported_file(const PageRequest& request) const {
  const BoardView<dim> view = board_->view();
  const auto format = request.parameters.find("format");
  if (!view.shape || format == request.parameters.end()) return no_shape();
  const auto file = exported(*view.shape, format->second);
  if (!file) return message(422, false, file.failure().reason);
  return {.type = "application/octet-stream", .body = *file};
}

template <int dim>
PageAnswer WatchSession<dim>::report() const {
  const BoardView<dim> view = board_->view();
  if (!view.shape) return no_shape();
  const auto page = design_report(folder_, view.first->psi, *view.shape);
  if (!page) return message(422, false, page.failure().reason);
  return {.type = "application/octet-stream", .body = *page};
}

template <int dim>
PageAnswer WatchSession<dim>::save(const PageRequest& request) const {
  const BoardView<dim> view = board_->view();
  if (!view.shape) return no_shape();
  const auto file = save_design(folder_, request.body, *view.shape);
  if (!file) return message(422, false, file.failure().reason);
  return message(200, true, file->string());
}

template class WatchSession<2>;
template class WatchSession<3>;

}  // namespace wheelwright
