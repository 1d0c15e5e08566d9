#pragma once

#include <abut/crew.h>

#include "massive/job_plan.h"
#include "massive/job_result.h"

namespace abut {

/// Does all the work of a plan together with the helpers of a crew, each in help_find_clashes.
///
/// Errors      what went wrong first, in whichever process. The helpers go on to wait for the leader
///             to leave the crew.
void lead(Crew& crew, const JobPlan& plan, JobResult& result, const ClashOptions& options,
          const std::string& store);

} // namespace abut
