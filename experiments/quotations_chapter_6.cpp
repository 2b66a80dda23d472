// What Chapters 6, 7 and the appendices of the thesis says, by claim.
#include "experiments/quotations.hpp"

namespace incognita {

std::span<const Quotation> quotations_of_chapter_6() {
  static constexpr Quotation all[] = {
      {"6.2-between", "6.1.1",
       "Moving to the location in between landmarks 2 and 3 maximises the mutual information between the SLAM prior and the measurements for this particular example."},
      {"6.3-random", "6.2",
       "The aim is to optimise both the localisation of the sensor and building of the feature map by computing the most appropriate control actions or movements."},
      {"6.3-fixed", "6.2",
       "The aim is to optimise both the localisation of the sensor and building of the feature map by computing the most appropriate control actions or movements."},
      {"6.3-standing", "6.2",
       "The aim is to optimise both the localisation of the sensor and building of the feature map by computing the most appropriate control actions or movements."},
      {"6.3.2-random", "6.2",
       "The aim is to optimise both the localisation of the sensor and building of the feature map by computing the most appropriate control actions or movements."},
      {"6.3.2-fixed", "6.2",
       "The aim is to optimise both the localisation of the sensor and building of the feature map by computing the most appropriate control actions or movements."},
      {"6.3.2-standing", "6.2",
       "The aim is to optimise both the localisation of the sensor and building of the feature map by computing the most appropriate control actions or movements."},
      {"6.3-14th-entropy", "6.3.1",
       "But, at the point at which the same number of landmarks is available it has lower entropy than the other two strategies"},
      {"6.3-fewer-landmarks", "6.3.1",
       "The constant rotational velocity and the mutual information strategies tend to insert landmarks into the map at a faster pace than the Fisher Information strategy."},
      {"6.3-unseen-pay", "6.3.1",
       "This is the only thing that prevents our control strategies from defaulting to homeostasis"},
      {"6.4-random", "6.4.2",
       "The aim is to choose impulsive acceleration commands for the vehicle in order to explore a small room while trying to reduce most the uncertainty."},
      {"6.4-fixed", "6.4.2",
       "The aim is to choose impulsive acceleration commands for the vehicle in order to explore a small room while trying to reduce most the uncertainty."},
      {"6.4-standing", "6.4.2",
       "The aim is to choose impulsive acceleration commands for the vehicle in order to explore a small room while trying to reduce most the uncertainty."},
      {"6.4.3-random", "6.4.2",
       "The aim is to choose impulsive acceleration commands for the vehicle in order to explore a small room while trying to reduce most the uncertainty."},
      {"6.4.3-fixed", "6.4.2",
       "The aim is to choose impulsive acceleration commands for the vehicle in order to explore a small room while trying to reduce most the uncertainty."},
      {"6.4.3-standing", "6.4.2",
       "The aim is to choose impulsive acceleration commands for the vehicle in order to explore a small room while trying to reduce most the uncertainty."},
      {"6.4-backwards", "6.4.2",
       "Interestingly enough, the system autonomously explores by repeatedly choosing a negative linear acceleration."},
      {"6.4-one-cycle", "6.4.2",
       "Accelerations are applied only every 15th step, and in between action decision, null acceleration is set"},
      {"6.4-bounds", "6.4.2",
       "Moreover, state estimation errors are shown in Figure 6.10 for the camera pose."},
      {"6.4.3-backwards", "6.4.3",
       "autonomously explores the room driving the vehicle back and forth, but mostly backwards, enlarging the field of view by pulling away from the initial view."},
  };
  return all;
}

}  // namespace incognita
