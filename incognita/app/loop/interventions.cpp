#include "incognita/app/loop/interventions.hpp"

#include <memory>
#include <stdexcept>
#include <utility>

#include "incognita/app/loop/body_models.hpp"
#include "incognita/decision/decision.hpp"
#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

namespace incognita {
namespace {

constexpr const char* changeable = "decision.";

bool has_images(const Scenario& s) { return !s.is_simulated() && s.sensor.type == "camera"; }

/// Puts the wrapper in the place of what it wraps, and returns it.
template <class Wrapper, class Part, class... More>
Wrapper* wrap(std::unique_ptr<Part>& part, More... more) {
  auto wrapper = std::make_unique<Wrapper>(std::move(part), more...);
  Wrapper* const out = wrapper.get();
  part = std::move(wrapper);
  return out;
}

}  // namespace

std::vector<std::string> possible_disturbances(const Scenario& scenario) {
  std::vector<std::string> names;
  if (has_images(scenario)) names = {"cover-lens", "image-noise", "light"};
  if (!scenario.has_recorded_motion() && !scenario.is_robot())
    names.insert(names.end(), {"displace", "push"});
  return names;
}

bool can_be_taken_over(const Scenario& scenario) { return !scenario.has_recorded_motion(); }

Interventions::Interventions(LoopParts& parts, const Scenario& scenario, InterventionSource& source)
    : parts_(parts),
      source_(source),
      images_(wrap<DisturbedImages>(parts.sensor, static_cast<std::uint64_t>(scenario.run.seed))),
      strategy_(wrap<TakenOver>(parts.strategy)),
      bodies_(dynamic_cast<const SlamEstimator&>(*parts.estimator).settings().bodies.size()),
      has_images_(has_images(scenario)),
      controlled_(can_be_taken_over(scenario)) {}

void Interventions::check_body(std::size_t body) const {
  if (body >= bodies_)
    throw std::invalid_argument("body " + std::to_string(body + 1) + " does not exist; there are " +
                                std::to_string(bodies_));
}

void Interventions::change(const ChangeDecision& change) {
  auto* const decision = dynamic_cast<Decision*>(&strategy_->strategy());
  if (!decision)
    throw std::invalid_argument("there is no decision to change: the bodies of this scenario follow paths");
  std::vector<std::string> settings = settings_;
  for (const std::string& setting : change.settings) {
    if (!setting.starts_with(changeable))
      throw std::invalid_argument(setting +
                                  ": only settings of `decision` can change during a run; start another");
    const std::string key = setting.substr(0, setting.find('=') + 1);
    std::erase_if(settings, [&](const std::string& earlier) { return earlier.starts_with(key); });
    settings.push_back(setting);
  }
  const LoadedScenario loaded = source_.reloaded(settings);
  const auto& estimator = dynamic_cast<const SlamEstimator&>(*parts_.estimator);
  decision->change(choices_for(estimator, active_settings_of(loaded.scenario)));
  settings_ = std::move(settings);
}

void Interventions::apply(const Intervention& intervention) {
  struct Apply {
    Interventions& on;
    void needs_images() const {
      if (!on.has_images_) throw std::invalid_argument("there are no images in this scenario");
    }
    void needs_control(std::size_t body) const {
      on.check_body(body);
      if (!on.controlled_) throw std::invalid_argument("recorded bodies cannot be driven");
    }
    void operator()(const CoverLens& i) const { needs_images(), on.images_->cover(i); }
    void operator()(const AddImageNoise& i) const { needs_images(), on.images_->add_noise(i); }
    void operator()(const ChangeLight& i) const { needs_images(), on.images_->change_light(i); }
    void operator()(const DisplaceBody& i) const { on.parts_.world->displace(i); }
    void operator()(const PushBody& i) const { on.parts_.world->push(i); }
    void operator()(const TakeOverBody& i) const { needs_control(i.body), on.strategy_->take_over(i.body); }
    void operator()(const GiveBackBody& i) const { needs_control(i.body), on.strategy_->give_back(i.body); }
    void operator()(const DriveBody& i) const { needs_control(i.body), on.strategy_->drive(i); }
    void operator()(const ChangeDecision& i) const { on.change(i); }
  };
  std::visit(Apply{*this}, intervention);
}

void Interventions::apply_due(const Tick& tick) {
  taken_.clear();
  tick_ = tick;
  for (Intervention& intervention : source_.due(tick)) {
    try {
      apply(intervention);
    } catch (const std::invalid_argument& error) {
      source_.refused(intervention, error.what());
      continue;
    } catch (const InputError& error) {
      source_.refused(intervention, error.what());
      continue;
    }
    taken_.push_back(std::move(intervention));
  }
}

void Interventions::state(StateArchive& archive) {
  std::vector<std::string> settings = settings_;
  archive(settings);
  if (archive.restores() && !settings.empty()) change({settings});
}

}  // namespace incognita
