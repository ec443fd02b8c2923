// phalanx plan: what a scene needs, before anything is rendered.
#include "../plan/plan.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "../core/error.h"
#include "../report/plan_json.h"
#include "../wavefront/isa.h"
#include "commands.h"
#include "load_scene.h"
#include "picture_options.h"
#include "text.h"

namespace phalanx {
namespace {

struct PlanCommand {
  std::string scene;
  RenderOptions options;
  bool json = false;
};

int run_plan(const PlanCommand &command) {
  RenderOptions options = command.options;
  options.isa = resolve_isa(options.isa);
  const auto [description, scene] = load_scene(command.scene);

  const Plan plan = make_plan(description, scene, options);
  const MemoryPlan memory = plan_memory(plan, scene);
  if (command.json)
    fmt::print("{}\n", plan_json(plan, memory).dump(2));
  else
    fmt::print("{}", plan_text(plan, memory));
  return kExitDone;
}

}  // namespace

void add_plan_command(CLI::App &app, int &exit_code) {
  auto command = std::make_shared<PlanCommand>();
  CLI::App *sub = app.add_subcommand("plan", "Show what a scene needs and what was left out");
  add_picture_options(*sub, command->scene, command->options);
  sub->add_flag("--json", command->json, "Print JSON");
  sub->footer("Example:\n  phalanx plan scenes/cornell-box.json --size 1920x1080");
  sub->callback([command, &exit_code] { exit_code = run_plan(*command); });
}

}  // namespace phalanx
