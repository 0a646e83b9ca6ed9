//! What the images take: flash, RAM, stack, instructions, within the budgets of `firmware/budgets.toml`.
