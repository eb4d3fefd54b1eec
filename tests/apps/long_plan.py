"""A plan with many steps, for tests and measurements of report pages."""


def repeat_motion(plan, steps):
    """Repeat the only in-hand motion of a plan and its inverse, up to a number of steps.

    Args:
        plan: plan for a hand, as a dict. Its only step is a motion of all fingers. It is changed.
        steps: even number of steps.
    """
    motion, = plan["steps"]
    assert motion["kind"] == "move" and steps % 2 == 0
    inverse = {"kind": "move", "path": motion["path"][::-1]}
    plan["steps"] = [motion, inverse] * (steps // 2)
    plan["hand"]["goal"] = plan["hand"]["initial"]["pose"]
    plan["goal"] = {"contacts": [{key: contact[key] for key in ("point", "normal")}
                                 for contact in plan["initial"]["contacts"]]}
