; A tank that is filled by a valve and delivers through a drain. Levels are in decimetres.
(define (domain tank)
  (:requirements :typing :numeric-fluents)
  (:types tank quantity - object)
  (:functions
    (level ?t - tank)
    (highest ?t - tank)
    (delivered ?t - tank)
    (amount ?q - quantity)
    (effort))

  (:action fill
    :parameters (?t - tank ?q - quantity)
    :precondition (<= (+ (level ?t) (amount ?q)) (highest ?t))
    :effect (and (increase (level ?t) (amount ?q)) (increase (effort) (amount ?q))))

  (:action deliver
    :parameters (?t - tank ?q - quantity)
    :precondition (>= (level ?t) (amount ?q))
    :effect (and (decrease (level ?t) (amount ?q)) (increase (delivered ?t) (amount ?q)))))
