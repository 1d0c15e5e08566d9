#pragma once

#include <abut/crew.h>

#include "massive/job/job_plan.h"
#include "massive/job/job_result.h"

namespace abut {

/// Does all work of a plan together with the helpers of a crew; each helper runs help_find_clashes.
/// Called by the leader.
///
/// Errors      the first failure, in whichever process it occurred. The helpers then wait for the
///             leader to leave the crew.
void lead(Crew& crew, const JobPlan& plan, JobResult& result, const ClashOptions& options,
          const std::string& store);

} // namespace abut
