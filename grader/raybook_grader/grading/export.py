"""`grades.json`: the grades of a class for other programs."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from zoneinfo import ZoneInfo

from ..database import Database, Module, Student
from ..files import write_text
from ..policy import Policy, Settled, late_days_used, settled_json
from .result import ModuleResult
from .totals import totals

VERSION = 1
NAME = "grades.json"


def write_grades(database: Database, folder: Path) -> Path:
    """Write ``folder``/grades.json, complete or not at all. All work must be done."""
    file = folder / NAME
    write_text(file, json.dumps(grades(database), indent=1) + "\n")
    return file


def grades(database: Database) -> dict[str, Any]:
    """All submissions with their modules and checks; ``score`` is null where the harness failed."""
    modules, policy = database.modules(), database.policy()
    submissions = [_submission(s, modules, policy) for s in database.students()]
    return {
        "version": VERSION,
        "course": database.course(),
        "unsafe": any(module["unsafe"] for s in submissions for module in s["modules"]),
        "submissions": submissions,
    }


def _submission(student: Student, modules: list[Module], policy: Policy) -> dict[str, Any]:
    sums = totals(student, modules)
    return {
        "id": student.id,
        "score": sums.score,
        "max_score": sums.max_score,
        "optional": sums.optional,
        "problem": student.problem,
        "late_days": {"budget": policy.late.days, "used": late_days_used(student.settled)},
        "modules": [
            _module(module, result, student.settled.get(module.number), policy.zone)
            for module in modules
            if (result := student.results.get(module.number)) is not None
        ],
    }


def _module(
    module: Module, result: ModuleResult, settled: Settled | None, zone: ZoneInfo
) -> dict[str, Any]:
    return {
        "assignment": module.number,
        "module": module.module,
        "score": result.score,
        "max_score": module.points,
        "verdict": result.verdict.value,
        **(settled_json(settled, zone) if settled else {}),
        "message": result.message,
        "unsafe": result.unsafe,
        "diagnosis": [diagnosis.to_json() for diagnosis in result.diagnosis],
        "checks": [
            {
                "name": check.name,
                "kind": check.kind,
                "score": check.score,
                "max_score": check.max_score,
                "status": check.status.value,
                "message": check.told,
            }
            for check in result.checks
        ],
    }
